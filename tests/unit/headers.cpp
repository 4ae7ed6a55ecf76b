// The only source of a program that exists to precompile headers (tests/CMakeLists.txt).
int main() { return 0; }
