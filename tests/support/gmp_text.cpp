// GMP's own library writes its numbers to GCC's streams alone: these are for LLVM's.
#include <gmpxx.h>

#include <string>

#ifdef _LIBCPP_VERSION

std::ostream& operator<<(std::ostream& out, mpz_srcptr number) {
  return out << mpz_class(number).get_str();
}

std::ostream& operator<<(std::ostream& out, mpq_srcptr number) {
  return out << mpq_class(number).get_str();
}

#endif
