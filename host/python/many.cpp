#include "host/python/many.h"

#include "host/python/arguments.h"
#include "host/python/flow.h"
#include "host/python/interpreter.h"
#include "host/python/keywords.h"
#include "host/python/session.h"
#include "vkhausdorff/error.h"

namespace vkh::python {
namespace {

namespace py = pybind11;

// Converts by a call, which all translators of exceptions stand behind.
py::object exception_of(const std::exception_ptr& error) {
  try {
    py::cpp_function([&] { std::rethrow_exception(error); })();
  } catch (const py::error_already_set& raised) {
    return raised.value();
  }
  return py::none();
}

Result streamed_result(const Question& question, FlowResult&& found) {
  Result result;
  if (found.error) {
    result.error = exception_of(found.error);
  } else {
    result = result_of(question, found.answer, found.a, found.b);
  }
  result.index = found.number;
  return result;
}

constexpr const char* kSelectors =
    "'', 'gpu', 'cpu', an index such as 0, part of a name, several of these between commas, or "
    "'all'";

size_t ahead_of(const Arguments& given) {
  constexpr const char* kExpected = "a whole number from 1 to 65536, or None";
  constexpr uint64_t kMost = 65536;
  const std::optional<uint64_t> count = given.whole("ahead", kExpected);
  if (!count) return 0;
  if (*count == 0 || *count > kMost) refuse_value("ahead", kExpected, given.at("ahead"));
  return static_cast<size_t>(*count);
}

bool is_given(const Arguments& given, const char* name) {
  const py::object* value = given.find(name);
  return value != nullptr && !value->is_none();
}

FlowQuestion asked_from(const Arguments& given) {
  FlowQuestion asked;
  Request request = request_of(kPyMany, "distances", given);
  asked.question = std::move(request.question);
  asked.ahead = ahead_of(given);
  asked.devices.together = request.many.together;
  asked.devices.lanes = request.many.lanes;
  asked.devices.devices = given.devices(kSelectors);
  if (is_given(given, "against"))
    asked.against =
        kept(mesh_of("against", "B", given.at("against"), asked.question.limits_of(true)));
  return asked;
}

py::object failed(size_t index, const py::object& id, const py::object& error) {
  Result result;
  result.index = index;
  result.id = id;
  result.error = error;
  return py::cast(std::move(result));
}

}  // namespace

PythonStream::PythonStream(const py::args& positional, const py::kwargs& named) {
  static const auto* signature =
      new Signature(signature_of(kPyMany, "distances", {"against", "ahead"}, 0, 0));
  const Call call;
  const Arguments given(*signature, positional, named);
  mark_used();
  FlowQuestion asked = asked_from(given);
  question_ = asked.question;
  const WithoutGil outside;
  flow_ = std::make_shared<Flow>(std::move(asked));
}

bool PythonStream::has_room() const {
  const Call call;
  return flow_ != nullptr && flow_->has_room();
}

void PythonStream::put(size_t index, const py::object& id, const py::object& a,
                       const py::object& b) {
  const Call call;
  const std::shared_ptr<Flow> flow = flow_;
  if (flow == nullptr) return;
  FlowPair pair{.number = index, .a = mesh_given("a", "A", a, question_.points_a), .b = {}};
  if (!b.is_none()) pair.b = mesh_given("b", "B", b, question_.points_b);
  if (!id.is_none()) ids_[index] = id;
  std::optional<WithoutGil> outside;
  if (!pair.a.file.empty() || !pair.b.file.empty()) outside.emplace();  // disks may be slow
  flow->put(std::move(pair));
}

py::object PythonStream::take(bool waits) {
  const Call call;
  const std::shared_ptr<Flow> flow = flow_;
  if (flow == nullptr) return py::none();
  std::optional<FlowResult> found = flow->take();
  if (!found && waits) {
    try {
      const WithoutGil outside;
      found = flow->wait();
    } catch (const Raised&) {
      throw py::error_already_set();
    }
  }
  if (!found) return py::none();
  Result result = streamed_result(question_, std::move(*found));
  const auto id = ids_.extract(*result.index);
  if (id) result.id = id.mapped();
  return py::cast(std::move(result));
}

// After a fork the parent's threads and devices are not there, and nothing of them may be touched.
void PythonStream::close() {
  std::shared_ptr<Flow> flow = std::move(flow_);
  flow_ = nullptr;
  ids_.clear();
  if (flow == nullptr) return;
  if (is_forked()) {
    static_cast<void>(new std::shared_ptr<Flow>(std::move(flow)));
    return;
  }
  try {
    const Call call;
    const WithoutGil outside;
    flow->end();
    flow.reset();
  } catch (const Ended&) {  // end_all() has been there, or will be
  }
}

PythonStream::~PythonStream() { close(); }

void define_many(py::module_& m) {
  constexpr const char* kName = "_Stream";
  py::class_<PythonStream>(m, kName, "What stands behind distances().")
      .def(py::init<const py::args&, const py::kwargs&>(),
           ("__init__(self, *, against=None, ahead=None, " + keywords_text(kPyMany, {}) +
            ")\n--\n\n")
               .c_str())
      .def("has_room",
           [](const py::object& self) { return made<PythonStream>(self, kName).has_room(); })
      .def("put",
           [](const py::object& self, size_t index, const py::object& id, const py::object& a,
              const py::object& b) { made<PythonStream>(self, kName).put(index, id, a, b); })
      .def("take", [](const py::object& self,
                      bool waits) { return made<PythonStream>(self, kName).take(waits); })
      .def("close", [](const py::object& self) { made<PythonStream>(self, kName).close(); });
  m.def("_failed", failed);
}

}  // namespace vkh::python
