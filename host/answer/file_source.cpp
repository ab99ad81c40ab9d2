#include "host/answer/file_source.h"

#include <atomic>
#include <new>
#include <optional>

#include "host/answer/input_hashes.h"
#include "host/answer/progress_line.h"
#include "host/answer/session.h"
#include "host/base/begin_now.h"
#include "host/base/system.h"
#include "host/mesh/default_pair.h"
#include "vkhausdorff/error.h"
#include "vkhausdorff/mesh_io.h"
#include "vkhausdorff/sha256.h"

namespace vkh {
namespace {

/// The state that the threads of a question share: they may outlive their source.
struct FileWork {
  const Question question;
  const Stop stop;
  const std::shared_ptr<ProgressLine> line;
};

/// Hashes all files that are read, beside the other work; a caller waits only for the result.
class Hashes {
 public:
  explicit Hashes(const std::shared_ptr<FileWork>& at)
      : at_(at), is_wanted_(at->question.hashes && !at->question.file_a.empty()) {
    if (!is_wanted_) return;
    for (const std::string& file : {at->question.file_a, at->question.file_b})
      digests_.push_back(begin_hash(file));
    for (const std::string& file : {at->question.face_max_a, at->question.face_max_b})
      limits_.push_back(begin_hash(file));
    matrix_ = begin_hash(at->question.transform_file);
  }

  /// Begins with the files beneath both. Call it once both are read: parsing a file for their names
  /// earlier would hold it in memory a second time.
  void begin_beneath() {
    if (!is_wanted_) return;
    for (const std::string& file : {at_->question.file_a, at_->question.file_b}) {
      beneath_.push_back(begin_now([at = at_, file]() -> Beneath {
        ReadLimits limits = at->question.limits;
        limits.keep_going = [at] { return !at->stop.is_asked(); };
        try {
          return hashes_beneath(file, limits);
        } catch (const Interrupted&) {
          return std::nullopt;
        } catch (const std::bad_alloc&) {  // it must not cost the answer
          return std::nullopt;
        }
      }));
    }
  }

  /// Writes the hashes of an input only if those of all its files are known.
  void fill(Answer& answer) {
    for (size_t i = 0; i < beneath_.size(); ++i) {
      Beneath beneath = beneath_[i].get();
      if (!beneath) continue;
      answer.inputs[i].sha256 = digests_[i].get();
      answer.inputs[i].files = std::move(*beneath);
    }
    if (is_wanted_ && answer.placed) answer.placed->sha256 = matrix_.get();
    if (!is_wanted_ || !answer.max) return;
    for (size_t i = 0; i < limits_.size(); ++i) {
      auto& faces = i == 0 ? answer.max->faces_a : answer.max->faces_b;
      if (faces) faces->sha256 = limits_[i].get();
    }
  }

 private:
  using Beneath = std::optional<std::vector<FileHash>>;

  std::future<std::string> begin_hash(const std::string& file) {
    return begin_now([at = at_, file] {
      if (file.empty()) return std::string();
      return sha256_of(path_of(file), [at] { return !at->stop.is_asked(); });
    });
  }

  std::shared_ptr<FileWork> at_;
  bool is_wanted_;
  std::vector<std::future<std::string>> digests_, limits_;
  std::future<std::string> matrix_;
  std::vector<std::future<Beneath>> beneath_;
};

std::future<Session> begin_opening(const Question& question) {
  const SessionRequest request{
      .selector = question.device,
      .several = question.several_devices,
      .threads = question.threads,
      .engine = engine_of(question),
      .cache_folder = question.caches ? user_cache_folder() : std::filesystem::path()};
  return begin_now([request] { return open_session(request); });
}

void use_built_in_pair(AskedPair& asked) {
  MeshPair pair = default_pair();
  asked.take(std::make_shared<ReadMesh>(std::move(pair.a)),
             shaped(std::make_shared<const ReadMesh>(std::move(pair.b))));
}

/// Reads both files at the same time. Throws what read_mesh throws, A's error before B's. Shows the
/// progress, and ends with Interrupted when it is to stop. After a bad A the call does not wait for
/// B, whose threads go on and keep `at`.
void read_files(const std::shared_ptr<FileWork>& at, AskedPair& asked) {
  constexpr uint64_t kWorthwhile = 100'000'000;  // about a second on one core
  const std::string &file_a = at->question.file_a, &file_b = at->question.file_b;
  const uint64_t bytes = file_bytes(path_of(file_a)) + file_bytes(path_of(file_b));
  const auto bytes_read = std::make_shared<std::atomic<uint64_t>>(0);
  const auto limits_of = [&](bool is_b) {
    ReadLimits limits = at->question.limits_of(is_b);
    limits.bytes_read = bytes_read.get();
    limits.keep_going = [bytes_read, bytes, at] {
      if (bytes >= kWorthwhile) at->line->show_reading(*bytes_read, bytes);
      return !at->stop.is_asked();
    };
    return limits;
  };
  auto b = begin_now([file_b, limits = limits_of(true)] {
    return std::make_shared<const ReadMesh>(read_mesh(path_of(file_b), limits));
  });
  auto a = std::make_shared<ReadMesh>(read_mesh(path_of(file_a), limits_of(false)));
  asked.take(std::move(a), shaped(b.get()));
}

class FileSource : public AskingSource {
 public:
  explicit FileSource(std::shared_ptr<FileWork> at) : at_(std::move(at)) {}

  // Begins with hashes and the device, too: not before, since a question may be refused.
  void read(AskedPair& pair) override {
    hashes_.emplace(at_);
    opening_ = begin_opening(at_->question);
    const auto start = Clock::now();
    if (at_->question.file_a.empty())
      use_built_in_pair(pair);
    else
      read_files(at_, pair);
    pair.answer().waits.read = 1000 * seconds_since(start);
    hashes_->begin_beneath();
  }
  std::span<Solver* const> open(double& ms) override {
    session_ = opening_.get();
    ms = session_.setup_ms;
    solvers_.push_back(session_.solver.get());
    for (const Opened& one : session_.more) solvers_.push_back(one.solver.get());
    return solvers_;
  }
  void end(Answer& answer) override { hashes_->fill(answer); }

  bool is_called_off() const override { return is_interrupted(); }
  double left_s() const override { return at_->stop.left_s(); }
  void hear(const WorkDone& done, const std::function<std::string()>& words) override {
    at_->line->show([&] {
      const std::string text = progress_text(done, at_->stop.left_s());
      return at_->question.verbose ? text + "  " + words() : text;
    });
  }

 private:
  const std::shared_ptr<FileWork> at_;
  std::optional<Hashes> hashes_;
  std::future<Session> opening_;
  Session session_;
  std::vector<Solver*> solvers_;
};

}  // namespace

std::unique_ptr<AskingSource> files_of(const Question& question, const Stop& stop,
                                       std::shared_ptr<ProgressLine> line) {
  return std::make_unique<FileSource>(
      std::make_shared<FileWork>(FileWork{question, stop, std::move(line)}));
}

}  // namespace vkh
