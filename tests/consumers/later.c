/* A library of the other project. */
int later(void);
int later(void) { return 0; }
