// The program: it does what the user asked, writes the answer to the requested places, and turns an
// error into one line on stderr and an exit code.
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <future>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

#include "host/answer/exit_code.h"
#include "host/answer/file_source.h"
#include "host/answer/option_values.h"
#include "host/answer/progress_line.h"
#include "host/app/arguments.h"
#include "host/app/doctor.h"
#include "host/app/many_pairs.h"
#include "host/app/out_of_memory.h"
#include "host/app/outputs.h"
#include "host/app/pictures.h"
#include "host/app/simplify_command.h"
#include "host/base/float_environment.h"
#include "host/base/output_file.h"
#include "host/base/system.h"
#include "vkhausdorff/error.h"

namespace vkh {
namespace {

int complain(const std::string& message, ExitCode code) {
  std::string line = message;
  std::replace(line.begin(), line.end(), '\n', ' ');
  std::fprintf(stderr, "vkhausdorff: %s\n", printable(line).c_str());
  std::fflush(stderr);
  return code;
}

void check_printed() {
  if (!std::cout.flush()) throw OutputError("cannot write the answer to standard output");
}

/// Runs after the answer is printed: the user wants to see the refuted answer.
void check_verified(const Answer& answer) {
  for (const Report* r : {&answer.a_to_b, answer.b_to_a ? &*answer.b_to_a : nullptr}) {
    if (r == nullptr || !r->witness_check) continue;
    if (!r->coverage_check || !r->coverage_check->holds) {
      throw DeviceError("--verify: a part of A is in no bound: do not trust this device or driver");
    }
    if (r->witness_check->holds) continue;
    throw DeviceError(
        "--verify: the host finds the witness closer than the certified lower bound: "
        "do not trust this device or driver");
  }
}

/// A running question, with its device, which is destroyed only once the answer is printed.
struct Asked {
  Asked(const Question& asked, const Stop& until)
      : question(asked),
        stop(until),
        state(std::make_shared<AskingState>(question, files_of(question, stop, line))),
        asking(state) {}

  const Question& question;
  const Stop& stop;
  const std::shared_ptr<ProgressLine> line = std::make_shared<ProgressLine>();
  const std::shared_ptr<AskingState> state;
  Asking asking;
};

/// Returns true once all work is done; false if the caller should not wait any longer.
bool is_waited_for(const Asked& at) {
  constexpr std::chrono::milliseconds kLook(20);
  constexpr double kGraceful =
      0.06;                       // within it a run on a GPU ends by itself, with more to report
  constexpr double kToAddUp = 3;  // a survey has files to write that the user asked for
  const Stop& stop = at.stop;
  // A certificate proves the final result of the search, so that is waited for too.
  const auto patience = [&] {
    return at.state->is_final() || at.question.certificate ? kToAddUp : kGraceful;
  };
  double asked_at = std::numeric_limits<double>::infinity();
  while (!at.asking.wait(Clock::now() + kLook)) {
    if (!stop.is_asked()) continue;
    asked_at = std::min(asked_at, stop.elapsed_s());
    if (stop.elapsed_s() - asked_at > patience()) return false;
  }
  return true;
}

/// Returns the answer known so far, for a caller that no longer waits for the run. Unless that
/// answer is final, its status says why the run was stopped.
Answer unfinished(const Asked& at) {
  at.line->end();
  Answer answer = at.state->known();
  if (at.state->is_final()) return answer;
  answer.a_to_b.status = at.stop.why();
  if (answer.b_to_a) answer.b_to_a->status = at.stop.why();
  return answer;
}

/// `a` and `b`: the meshes as they were measured; null where the run was ended before.
struct Answered {
  std::unique_ptr<Asked> asked;
  Answer answer;
  std::shared_ptr<const ReadMesh> a, b;
};

/// If the question was stopped, the answer is what is known so far: its interval is true, but may
/// be [0, infinity).
void fetch_answer(Answered& done) {
  Asked& at = *done.asked;
  if (!is_waited_for(at)) {
    at.asking.leave();
    done.answer = unfinished(at);
    return;
  }
  try {
    at.state->check();
  } catch (const Interrupted&) {
    done.answer = unfinished(at);
    return;
  }
  at.line->end();
  AskedPair& pair = at.state->pair();
  done.answer = std::move(pair.answer());
  done.a = pair.a();
  done.b = pair.b();
}

/// Returns the answer, or writes the error to the outputs and throws it.
Answered answer_for(const Question& question, const Stop& stop, Destinations& destinations) {
  try {
    Answered done;
    done.asked = std::make_unique<Asked>(question, stop);
    fetch_answer(done);
    done.answer.waits.total = stop.elapsed_s() * 1000;
    return done;
  } catch (const Error& error) {
    destinations.write(failure_of(error));
    throw;
  }
}

/// Refuses two outputs in one file.
void check_distinct(const Outputs& outputs) {
  std::set<std::filesystem::path> places;
  for (const std::optional<std::string>& file :
       {outputs.json_file, outputs.junit, outputs.transform, outputs.field, outputs.image,
        outputs.report, outputs.certificate, outputs.figures, outputs.points}) {
    if (file && !places.insert(std::filesystem::absolute(path_of(*file)).lexically_normal()).second)
      throw UsageError("two outputs would be written to '" + *file + "'");
  }
}

struct Places {
  Destinations destinations;
  Pictures pictures;
};

std::string case_name_of(const Request& asked) {
  const Question& question = asked.question;
  return pair_name(question.file_a, question.file_b, question.symmetric, typed_max(asked));
}

Places places_of(const Request& asked) {
  check_distinct(asked.outputs);
  const Question& question = asked.question;
  const std::vector<std::string> inputs = {question.file_a, question.file_b, question.face_max_a,
                                           question.face_max_b, question.transform_file};
  return {
      .destinations = Destinations(asked.outputs, inputs, case_name_of(asked), question.verbose),
      .pictures = Pictures(asked.outputs, question.symmetric, inputs)};
}

/// Reports the misuse of words that name no place for an answer, or not yet: programs may wait for
/// one.
template <class F>
auto or_tell(const Words& words, const F& work) {
  try {
    return work();
  } catch (const UsageError& error) {
    report_misuse(words, error);
    throw;
  }
}

int run_pair(const Request& asked, const Words& words, const Stop& stop) {
  auto [destinations, pictures] = or_tell(words, [&] { return places_of(asked); });
  Answered done = answer_for(asked.question, stop, destinations);
  std::string not_written = destinations.write(done.answer);
  // NVIDIA's driver takes some 40 ms to destroy a device: pictures are drawn meanwhile.
  std::future<void> closing = std::async([&done] { done.asked.reset(); });
  const std::string not_drawn = pictures.write(done.answer, done.a, done.b);
  closing.get();
  if (!not_drawn.empty()) not_written += (not_written.empty() ? "" : "; ") + not_drawn;
  check_printed();
  check_verified(done.answer);
  if (!not_written.empty()) return complain(not_written, kExitNotWritten);
  return code_of(done.answer);
}

int printed(ExitCode code) {
  check_printed();
  return code;
}

/// Examines the devices, and writes JSON if asked for, even if the doctor could not finish.
bool examine_and_write(const Request& asked) {
  const Outputs& outputs = asked.outputs;
  const std::string& device = asked.question.device;
  const bool is_json = outputs.json;
  if (!is_json && !outputs.json_file) return examine_devices(std::cout, device, nullptr);
  std::optional<OutputFile> file;
  if (outputs.json_file) file.emplace("--json", *outputs.json_file, std::vector<std::string>());
  Json json;
  const auto write = [&] {
    const std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
    if (file) file->write(text);
    if (is_json) std::cout << text << std::flush;
  };
  std::ostringstream unseen;
  try {
    const bool passed = examine_devices(is_json ? unseen : std::cout, device, &json);
    write();
    return passed;
  } catch (const DeviceError&) {
    write();
    throw;
  }
}

int run_doctor(const Request& asked) {
  const bool passed = examine_and_write(asked);
  check_printed();
  if (!passed) throw DeviceError("the self-check failed: do not trust this device or driver");
  return kExitClosed;
}

int run(const Words& words, Clock::time_point start) {
  const CommandLine line = or_tell(words, [&] { return understand(words); });
  if (!line.help.empty()) {
    std::cout << line.help;
    return printed(kExitClosed);
  }
  const Request& asked = line.asked;
  if (asked.command == kDoctor) return run_doctor(asked);
  if (asked.command == kMerge) return printed(run_merge_command(asked));
  note_interrupts();
  const Stop stop(start, asked.question.budget.time_limit_s);
  if (asked.command == kBatch) return printed(run_batch_command(asked));
  if (asked.command == kSimplify) return printed(run_simplify_command(asked, stop));
  return run_pair(asked, words, stop);
}

int run_and_catch(const Words& words, Clock::time_point start) {
  try {
    return run(words, start);
  } catch (const Error& error) {
    return complain(error.what(), code_of(error.kind()));
  } catch (const std::bad_alloc&) {
    return complain_of_memory(kExitDevice);
  } catch (const std::exception& error) {
    return complain(std::string("internal error: ") + error.what(), kExitInternal);
  } catch (...) {
    return complain("internal error", kExitInternal);
  }
}

int run_in_console(int argc, char** argv, Clock::time_point start) {
  const Console console;
  const int code = run_and_catch(command_line(argc, argv), start);
  std::cout.flush();
  std::fflush(nullptr);
  return code;
}

}  // namespace
}  // namespace vkh

// Ends without exit handlers: after a bad file, or when the time was over, threads may still be at
// work on a file or in the driver. After a complete run the device is already gone: Mesa saves what
// it compiled then.
int main(int argc, char** argv) {
  const auto start = vkh::Clock::now();
  const vkh::FloatEnvironment ours;
  vkh::end_where_memory_ends(vkh::kExitDevice);
  const int code = vkh::run_in_console(argc, argv, start);
#ifdef __SANITIZE_ADDRESS__
  __lsan_do_leak_check();
#endif
  vkh::end_process(code);
}
