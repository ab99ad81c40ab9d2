#include "host/python/proof.h"

#include <cmath>

#include "host/base/error.h"
#include "host/base/float_environment.h"
#include "host/python/session.h"
#include "host/survey/certificate.h"

namespace vkh::python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

/// Reads a text, or an object from which os.fspath() makes one.
std::string path_from(const py::object& given) {
  constexpr const char* kExpected = "the path of a file that ends in .vhc, or None";
  py::object text = given;
  if (py::hasattr(given, "__fspath__")) text = py::module_::import("os").attr("fspath")(given);
  std::string path = text_from("certificate", kExpected, text);
  if (!path.ends_with(".vhc")) refuse_value("certificate", kExpected, text);
  return path;
}

py::dict stats_of(const Proof& proof) {
  return py::dict("upper"_a = proof.upper, "leaves"_a = proof.leaves,
                  "cut_leaves"_a = proof.cut_leaves, "unproven"_a = proof.unproven,
                  "wall_ms"_a = proof.ms);
}

}  // namespace

Certificate::Certificate(const Arguments& given, const SolveOptions& options) : options_(options) {
  const py::object* path = given.find("certificate");
  if (path == nullptr || path->is_none()) return;
  file_.emplace("certificate", path_from(*path), std::vector<std::string>{});
}

// If a run was called off, or took all of its time, its bound is proven to what it can be at once.
std::optional<Proof> Certificate::proof_of(Solver& solver, const PairView& pair,
                                           const Report& report) const {
  if (!std::isfinite(report.upper)) return std::nullopt;
  FloatEnvironment ours;
  const auto goes_on = [&](size_t) {
    ours.outside(hear_signals);
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    return report.status != Status::kCancelled && spent.count() < options_.time_limit_s;
  };
  return prove(solver, {pair.a, pair.b, report, options_, goes_on});
}

void Certificate::make(Solver& solver, const PairView& pair, const Report& a_to_b,
                       const Report* b_to_a) {
  if (!is_asked()) return;
  there_ = proof_of(solver, pair, a_to_b);
  if (b_to_a != nullptr && there_) back_ = proof_of(solver, {pair.b, pair.a}, *b_to_a);
  const bool is_whole = there_ && (b_to_a == nullptr || back_);
  if (!is_whole) {
    there_.reset();
    return;
  }
  std::optional<CertifiedDirection> back;
  if (b_to_a != nullptr) back.emplace(CertifiedDirection{*b_to_a, *back_});
  const std::string text = certificate_of({pair.a, ""}, {pair.b, ""}, {a_to_b, *there_}, back);
  file_->write(text);
  bytes_ = text.size();
  is_less_ = there_->upper > a_to_b.upper || (back_ && back_->upper > b_to_a->upper);
}

void Certificate::tell(Answer& answer) const {
  if (!is_asked()) return;
  py::object certificate = py::none();
  if (there_ && !back_) {
    certificate = stats_of(*there_);
  } else if (there_) {
    certificate = py::dict("upper"_a = std::max(there_->upper, back_->upper),
                           "a_to_b"_a = stats_of(*there_), "b_to_a"_a = stats_of(*back_));
  }
  if (there_) certificate["bytes"] = bytes_;
  answer.stats["certificate"] = certificate;
  if (!is_less_) return;
  const char* text =
      "the certificate proves less than upper says: see stats['certificate']['upper']";
  if (PyErr_WarnEx(PyExc_RuntimeWarning, text, 1) != 0) throw py::error_already_set();
}

}  // namespace vkh::python
