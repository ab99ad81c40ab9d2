// Members of an answer as Python's dicts, lists and numbers: each is there under its name in JSON.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "host/answer/member_writer.h"

namespace vkh::python {

/// A tree of MemberWriter. Bounds are doubles, without texts in hexadecimal; faces are rows of the
/// arrays.
class PythonTree {
 public:
  /// Objects whose names are in `flat` become no dicts: their members go to the dict around them.
  explicit PythonTree(std::initializer_list<std::string_view> flat);

  void key(const char* name) { key_ = name; }
  void null() { put(pybind11::none()); }
  void truth(bool truth) { put(pybind11::bool_(truth)); }
  void count(uint64_t count) { put(pybind11::int_(count)); }
  void number(double number) { put(pybind11::float_(number)); }
  void bound(const char* name, double bound, Rounding);
  void estimate(const Enclosure& e) { number(*e.estimate); }
  void face(const SurfacePoint& point) { count(point.face); }
  void text(std::string_view text);
  void open_object();
  void open_array() { open(pybind11::list()); }
  void close() { open_.pop_back(); }

  pybind11::dict members() const { return members_; }

 private:
  void put(const pybind11::object& value);
  void open(const pybind11::object& value);

  std::vector<std::string_view> flat_;
  pybind11::dict members_;
  std::vector<pybind11::object> open_{members_};
  std::string key_;
};

/// Text as Python has it: bytes of a file's name that are no UTF-8 are replaced.
pybind11::str text_object(std::string_view text);

/// The members that `visit` gives to a MemberWriter. `unit`: of the answer's lengths.
template <class Visit>
pybind11::dict members_of(const std::string& unit, const Visit& visit,
                          std::initializer_list<std::string_view> flat = {}) {
  PythonTree tree(flat);
  MemberWriter writer(tree, Detail::kFull);
  writer.in_unit(unit);
  visit(writer);
  return tree.members();
}

/// The counts of a mesh that was read.
pybind11::dict counts_dict(const MeshCounts& counts);
/// A device, with its driver.
pybind11::dict device_dict(const DeviceDescription& device);

}  // namespace vkh::python
