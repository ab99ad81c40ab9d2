// LAS files for tests.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace vkh::test {

/// A LAS 1.2 file of points of format 0, whose parts a test can set.
class Las {
 public:
  Las() : bytes_(227, '\0') {
    bytes_.replace(0, 4, "LASF");
    bytes_[24] = 1;
    bytes_[25] = 2;
    put(94, uint16_t{227});
    put(96, uint32_t{227});
    put(105, uint16_t{20});
  }
  template <class T>
  void put(size_t at, T value) {
    std::memcpy(&bytes_[at], &value, sizeof value);
  }
  void put_points(const std::vector<std::array<int32_t, 3>>& numbers) {
    put(107, static_cast<uint32_t>(numbers.size()));
    bytes_.resize(227 + 20 * numbers.size());
    for (size_t p = 0; p < numbers.size(); ++p) put(227 + 20 * p, numbers[p]);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace vkh::test
