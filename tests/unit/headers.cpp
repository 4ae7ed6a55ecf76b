// The only source of a program that exists to precompile headers for the tests (tests/CMakeLists.txt).
int main() { return 0; }
