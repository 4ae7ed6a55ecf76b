// The compiled parts of Asio and Beast, which every file would otherwise compile again.

#include <boost/asio/impl/src.hpp>
#include <boost/beast/src.hpp>
