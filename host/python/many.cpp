#include "host/python/many.h"

#include <set>

#include "host/answer/asking_stream.h"
#include "host/python/arguments.h"
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

constexpr const char* kSelectors =
    "'', 'gpu', 'cpu', 'native', an index such as 0, part of a name, several of these between "
    "commas, or "
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

/// The question about every pair, and its devices.
struct AskedOfAll {
  Question question;   ///< its `limits` are for files
  ShapedMesh against;  ///< the B of all; null: each has its own
  StreamOptions
      devices;  ///< as many pairs wait as are put and not taken: no thread waits in push()
};

AskedOfAll asked_from(const Arguments& given) {
  AskedOfAll asked;
  Request request = request_of(kPyMany, "distances", given);
  asked.question = std::move(request.question);
  asked.devices.together = request.many.together;
  asked.devices.lanes = request.many.lanes;
  asked.devices.devices = given.devices(kSelectors);
  asked.devices.first = engine_of(asked.question);
  asked.devices.waiting = ahead_of(given);
  if (is_given(given, "against"))
    asked.against =
        kept(mesh_of("against", "B", given.at("against"), asked.question.limits_of(true)));
  return asked;
}

}  // namespace

/// Everything that runs on our threads. Only wait() touches Python, to check for signals.
class Pulled {
 public:
  explicit Pulled(AskedOfAll asked);
  ~Pulled();
  Pulled(const Pulled&) = delete;
  Pulled& operator=(const Pulled&) = delete;

  /// Returns a pair that has ended; null when none is left, or end() came. Called within a
  /// WithoutGil. Throws DeviceError if no device is left, and what ask() throws.
  std::unique_ptr<StreamedPair> wait();
  /// Drops waiting pairs, cancels running ones, and returns when no thread is left.
  void end();

  const AskedOfAll asked;
  AskingStream stream;

 private:
  std::mutex ending_;
};

namespace {

// This is never destroyed: see interpreter.cpp.
struct Alive {
  std::mutex mutex;
  std::set<Pulled*> all;
};
Alive& alive() {
  static auto* alive = new Alive;
  return *alive;
}

/// A pair that was put.
class GivenPair : public StreamedPair {
 public:
  GivenPair(size_t number, MeshGiven a, MeshGiven b, const Pulled& of)
      : index(number), a_(std::move(a)), b_(std::move(b)), of_(of) {}

  void read() override {
    const AskedOfAll& asked = of_.asked;
    const auto limits_of = [&](bool is_b) {
      ReadLimits limits = asked.question.limits_of(is_b);
      limits.keep_going = [this] { return !of_.stream.is_cancelled(); };
      return limits;
    };
    const MeshPointer a = made_mesh(std::move(a_), limits_of(false));
    pair = std::make_unique<AskedPair>(asked.question);
    pair->take(a, shares_b() ? asked.against : shaped(made_mesh(std::move(b_), limits_of(true))));
  }
  bool shares_b() const override { return of_.asked.against.mesh != nullptr; }
  bool has_more() const override { return of_.asked.question.asks_for_cells(); }
  void finish(AskedPair& solved, Solver& solver) override {
    solved.finish(solver, {.goes_on = [this] { return !of_.stream.is_cancelled(); }});
  }

  const size_t index;

 private:
  MeshGiven a_, b_;
  const Pulled& of_;
};

}  // namespace

Pulled::Pulled(AskedOfAll given) : asked(std::move(given)), stream(asked.devices) {
  const std::lock_guard lock(alive().mutex);
  alive().all.insert(this);
}

Pulled::~Pulled() {
  {
    const std::lock_guard lock(alive().mutex);
    alive().all.erase(this);
  }
  end();
}

std::unique_ptr<StreamedPair> Pulled::wait() {
  constexpr std::chrono::milliseconds kStep(50);
  while (!stream.wait(std::chrono::steady_clock::now() + kStep)) {
    stream.check();
    hear_signals();
  }
  std::unique_ptr<StreamedPair> found = stream.take();
  if (found == nullptr) stream.check();
  return found;
}

void Pulled::end() {
  const std::lock_guard only_one(ending_);
  stream.cancel();
  try {
    stream.finish();
  } catch (...) {  // no caller wants the error any more
  }
}

void end_streams() {
  const std::lock_guard lock(alive().mutex);
  for (Pulled* one : alive().all) one->end();
}

PythonStream::PythonStream(const py::args& positional, const py::kwargs& named) {
  static const auto* signature =
      new Signature(signature_of(kPyMany, "distances", {"against", "ahead"}, 0, 0));
  const Call call;
  const Arguments given(*signature, positional, named);
  mark_used();
  AskedOfAll asked = asked_from(given);
  const WithoutGil outside;
  pulled_ = std::make_shared<Pulled>(std::move(asked));
}

bool PythonStream::has_room() const {
  const Call call;
  return pulled_ != nullptr && waiting_.size() < pulled_->asked.devices.most_waiting() &&
         bytes_ <= AskingStream::kReadAhead;
}

void PythonStream::put(size_t index, const py::object& id, const py::object& a,
                       const py::object& b) {
  const Call call;
  const std::shared_ptr<Pulled> pulled = pulled_;
  if (pulled == nullptr) return;
  const Question& question = pulled->asked.question;
  MeshGiven mesh_a = mesh_given("a", "A", a, question.points_a), mesh_b;
  if (!b.is_none()) mesh_b = mesh_given("b", "B", b, question.points_b);
  uint64_t bytes = 0;
  {
    std::optional<WithoutGil> outside;
    if (!mesh_a.file.empty() || !mesh_b.file.empty()) outside.emplace();  // disks may be slow
    bytes = mesh_a.bytes() + mesh_b.bytes();
  }
  waiting_[index] = {id, bytes};
  bytes_ += bytes;
  pulled->stream.put(
      std::make_unique<GivenPair>(index, std::move(mesh_a), std::move(mesh_b), *pulled));
}

py::object PythonStream::take(bool waits) {
  const Call call;
  const std::shared_ptr<Pulled> pulled = pulled_;
  if (pulled == nullptr) return py::none();
  std::unique_ptr<StreamedPair> found = pulled->stream.take();
  if (!found && waits) {
    try {
      const WithoutGil outside;
      found = pulled->wait();
    } catch (const Raised&) {
      throw py::error_already_set();
    }
  }
  if (!found) return py::none();
  const AskedPair* pair = found->pair.get();
  py::dict parts;
  if (found->error) {
    parts["error"] = exception_of(found->error);
  } else {
    parts = parts_of(pair->question(), pair->answer(), pair->a(), pair->b());
  }
  const size_t index = dynamic_cast<const GivenPair&>(*found).index;
  parts["index"] = index;
  const auto waiting = waiting_.extract(index);
  if (waiting) {  // another thread may have closed the stream meanwhile
    parts["id"] = waiting.mapped().id;
    bytes_ -= waiting.mapped().bytes;
  }
  return result_of(parts);
}

// After a fork the parent's threads and devices do not exist, and must not be touched.
void PythonStream::close() {
  std::shared_ptr<Pulled> pulled = std::move(pulled_);
  pulled_ = nullptr;
  waiting_.clear();
  if (pulled == nullptr) return;
  if (is_forked()) {
    static_cast<void>(new std::shared_ptr<Pulled>(std::move(pulled)));
    return;
  }
  try {
    const Call call;
    const WithoutGil outside;
    pulled->end();
    pulled.reset();
  } catch (const Ended&) {  // end_streams() has been there, or will be
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
}

}  // namespace vkh::python
