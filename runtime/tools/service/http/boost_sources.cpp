// Compiles the function bodies of Asio and Beast once for the whole library, instead of in every file that uses them.

#include <boost/asio/impl/src.hpp>
#include <boost/beast/src.hpp>
