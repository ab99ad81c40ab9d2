// An error has its parts, one line and a kind, and the kind alone decides the exit code.
#include "vkhausdorff/error.h"

#include <doctest/doctest.h>

#include <new>

#include "host/base/reject.h"
#include "vkhausdorff/answer.h"

namespace {

using namespace vkh;

template <class Thrown>
Error caught(const Thrown& thrown) {
  return error_of(std::make_exception_ptr(thrown));
}

TEST_CASE("an error's line is its parts") {
  const InputError whole(
      {.file = "a.obj", .place = "line 3", .problem = "a: b", .expected = "c; expected d"});
  CHECK(whole.what() == std::string("a.obj: line 3: a: b; expected c; expected d"));
  CHECK(whole.file() == "a.obj");
  CHECK(whole.place() == "line 3");
  CHECK(InputError({.file = "a.obj", .problem = "gone: so"}).what() ==
        std::string("a.obj: gone: so"));
  CHECK(OutputError({.option = "--json", .file = "x", .problem = "full"}).what() ==
        std::string("--json 'x': full"));
  CHECK(UsageError("a: b; expected c").what() == std::string("a: b; expected c"));
  CHECK(UsageError("a: b; expected c").file().empty());
}

TEST_CASE("an error about a file is one line, whatever the file's name holds") {
  const InputError error({.file = "a\n\x01.obj", .problem = "bad"});
  CHECK(error.what() == std::string("a??.obj: bad"));
  CHECK(error.file() == "a\n\x01.obj");
  CHECK(error.renamed("b: c").what() == std::string("b: c: bad"));
  CHECK(error.renamed("b: c").kind() == ErrorKind::kInput);
}

TEST_CASE("reject() throws the parts that it is given") {
  try {
    reject("x: y.stl", "byte 7", "wrong: very", "right");
  } catch (const Error& error) {
    CHECK(error.file() == "x: y.stl");
    CHECK(error.place() == "byte 7");
    CHECK(error.parts().problem == "wrong: very");
    CHECK(error.parts().expected == "right");
    return;
  }
  CHECK(false);
}

TEST_CASE("kinds and exit codes of what is thrown") {
  const auto check = [](const Error& error, ErrorKind kind, ExitCode code) {
    CHECK(error.kind() == kind);
    CHECK(code_of(error.kind()) == code);
  };
  check(caught(UsageError("x")), ErrorKind::kUsage, kExitUsage);
  check(caught(InputError("x")), ErrorKind::kInput, kExitBadInput);
  check(caught(DeviceError("x")), ErrorKind::kDevice, kExitDevice);
  check(caught(DeviceLost("x")), ErrorKind::kDeviceLost, kExitDevice);
  check(caught(MemoryError("x")), ErrorKind::kMemory, kExitDevice);
  check(caught(OutputError("x")), ErrorKind::kOutput, kExitNotWritten);
  check(caught(Interrupted("x")), ErrorKind::kInterrupted, kExitNotClosed);
  check(caught(std::bad_alloc()), ErrorKind::kMemory, kExitDevice);
  check(caught(std::logic_error("x")), ErrorKind::kInternal, kExitInternal);
  check(caught(7), ErrorKind::kInternal, kExitInternal);
  CHECK(caught(std::logic_error("why")).what() == std::string("why"));
}

TEST_CASE("lost devices and missing memory are errors of devices, and apart") {
  CHECK_THROWS_AS(throw DeviceLost("x"), DeviceError);
  CHECK_THROWS_AS(throw MemoryError("x"), DeviceError);
  CHECK_THROWS_AS(throw InputError("x"), Error);
  CHECK_THROWS_AS(throw InputError("x"), std::runtime_error);
}

TEST_CASE("a failure names the input that is at fault, and no output") {
  const Failure input =
      failure_of(InputError({.file = "a: b.obj", .place = "line 1", .problem = "c: d"}));
  CHECK(input.code == kExitBadInput);
  CHECK(input.message == "a: b.obj: line 1: c: d");
  CHECK(input.file == "a: b.obj");
  CHECK(input.place == "line 1");
  const Failure output =
      failure_of(UsageError({.option = "--out", .file = "x", .problem = "is a folder's name"}));
  CHECK(output.code == kExitUsage);
  CHECK(output.message == "--out 'x': is a folder's name");
  CHECK(output.file.empty());
}

}  // namespace
