/* A source file of the enclosing project's own library. */
int later(void);
int later(void) { return 0; }
