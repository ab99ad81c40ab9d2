// Stands in for libFuzzer where the compiler has none: reads inputs again, and changes them at
// random for a while. It takes the options that tools/fuzz and the tests pass, by libFuzzer's
// names:
//   driver [-runs=N] [-max_total_time=SECONDS] [-seed=N] [-max_len=BYTES] [-dict=FILE]
//          [-artifact_prefix=PATH] FILE_OR_FOLDER...
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "tests/verification/fuzz/fuzz_target.h"

namespace {

using Bytes = std::vector<uint8_t>;

struct Options {
  uint64_t runs = UINT64_MAX, seconds = 0, seed = 1, max_len = 4096;
  std::string artifact_prefix;
  std::vector<std::string> words;
  std::vector<Bytes> inputs;
};

std::mt19937_64 g_random;
std::vector<std::string> g_words;
Bytes g_current;
std::string g_artifact;

size_t pick(size_t count) { return static_cast<size_t>(g_random() % count); }

// Writes the input that ended the program, as libFuzzer does.
void keep_current() {
  std::ofstream(g_artifact, std::ios::binary)
      .write(reinterpret_cast<const char*>(g_current.data()),
             static_cast<std::streamsize>(g_current.size()));
  std::fprintf(stderr, "driver: the input is in %s\n", g_artifact.c_str());
}

extern "C" void on_abort(int) {
  keep_current();
  std::signal(SIGABRT, SIG_DFL);
  std::abort();
}

Bytes read_file(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Lines such as name="word", with \xNN, \\ and \".
std::vector<std::string> read_words(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::string> words;
  for (std::string line; std::getline(in, line);) {
    const size_t begin = line.find('"'), end = line.rfind('"');
    if (line.starts_with('#') || begin == end) continue;
    std::string word;
    for (size_t at = begin + 1; at < end; ++at) {
      if (line[at] == '\\' && line[at + 1] == 'x') {
        word += static_cast<char>(std::stoi(line.substr(at + 2, 2), nullptr, 16));
        at += 3;
      } else {
        word += line[at] == '\\' ? line[++at] : line[at];
      }
    }
    words.push_back(word);
  }
  return words;
}

void read_inputs(const std::string& path, std::vector<Bytes>& inputs) {
  if (!std::filesystem::exists(path)) return;  // no finding yet
  if (!std::filesystem::is_directory(path)) {
    inputs.push_back(read_file(path));
    return;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const auto& file : files) inputs.push_back(read_file(file));
}

bool take(const std::string& word, const char* option, std::string& value) {
  if (!word.starts_with(option)) return false;
  value = word.substr(std::strlen(option));
  return true;
}

Options understand(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    std::string value;
    if (take(word, "-runs=", value)) {
      options.runs = std::stoull(value);
    } else if (take(word, "-max_total_time=", value)) {
      options.seconds = std::stoull(value);
    } else if (take(word, "-seed=", value)) {
      options.seed = std::stoull(value);
    } else if (take(word, "-max_len=", value)) {
      options.max_len = std::stoull(value);
    } else if (take(word, "-artifact_prefix=", value)) {
      options.artifact_prefix = value;
    } else if (take(word, "-dict=", value)) {
      options.words = read_words(value);
    } else if (!word.starts_with('-')) {
      read_inputs(word, options.inputs);
    }  // else one of libFuzzer's, or the target's
  }
  return options;
}

void run_one(const Bytes& input) {
  g_current = input;
  LLVMFuzzerTestOneInput(g_current.data(), g_current.size());
}

void fuzz(const Options& options) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::seconds(options.seconds);
  uint64_t runs = 0;
  Bytes input;
  while (runs < options.runs && (options.seconds == 0 || Clock::now() < end)) {
    if (options.inputs.empty() || pick(8) == 0) {
      input.resize(pick(options.max_len + 1));
      for (uint8_t& byte : input) byte = static_cast<uint8_t>(g_random());
    } else {
      input = options.inputs[pick(options.inputs.size())];
      const size_t size = std::min<size_t>(input.size(), options.max_len);
      input.resize(options.max_len);
      input.resize(LLVMFuzzerCustomMutator(input.data(), size, input.size(),
                                           static_cast<unsigned>(g_random())));
    }
    run_one(input);
    ++runs;
  }
  std::fprintf(stderr, "driver: %llu executions\n", static_cast<unsigned long long>(runs));
}

}  // namespace

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size) {
  Bytes bytes(data, data + size);
  const auto at = [&] { return static_cast<std::ptrdiff_t>(pick(bytes.size() + 1)); };
  const auto from = std::min(at(), at()), to = std::max(from, at());
  switch (pick(6)) {
    case 0:
      bytes.erase(bytes.begin() + from, bytes.begin() + to);
      break;
    case 1: {
      const Bytes copy(bytes.begin() + from, bytes.begin() + to);
      bytes.insert(bytes.begin() + at(), copy.begin(), copy.end());
      break;
    }
    case 2:
      if (!g_words.empty()) {
        const std::string& word = g_words[pick(g_words.size())];
        bytes.insert(bytes.begin() + at(), word.begin(), word.end());
      }
      break;
    case 3:
      bytes.insert(bytes.begin() + at(), static_cast<uint8_t>(pick(256)));
      break;
    default:
      if (!bytes.empty()) bytes[pick(bytes.size())] ^= static_cast<uint8_t>(1 << pick(8));
  }
  bytes.resize(std::min(bytes.size(), max_size));
  std::copy(bytes.begin(), bytes.end(), data);
  return bytes.size();
}

int main(int argc, char** argv) {
  LLVMFuzzerInitialize(&argc, &argv);
  const Options options = understand(argc, argv);
  g_random.seed(options.seed);
  g_words = options.words;
  g_artifact = options.artifact_prefix + "crash-by-driver";
  std::signal(SIGABRT, on_abort);
  for (const Bytes& input : options.inputs) run_one(input);
  std::fprintf(stderr, "driver: %zu inputs read again\n", options.inputs.size());
  if (options.runs > 0 && (options.seconds > 0 || options.runs != UINT64_MAX)) fuzz(options);
  return 0;
}
