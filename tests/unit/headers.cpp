// Of a program whose headers are compiled ahead (tests/CMakeLists.txt): they are all that there is of it.
int main() { return 0; }
