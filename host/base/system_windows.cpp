#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>

#include "host/base/begin_now.h"
#include "host/base/system.h"
#include "host/base/windows_text.h"

namespace vkh {
namespace {

namespace fs = std::filesystem;

// The console's code page, which outlives the program; 0: there is no console, or it was restored.
std::atomic<UINT> g_code_page = 0;

void leave_console() {
  const UINT before = g_code_page.exchange(0);
  if (before != 0) SetConsoleOutputCP(before);
}

std::atomic<bool> g_interrupted = false;

// Runs on a thread of its own. False: the default handler ends the program.
BOOL WINAPI on_control(DWORD event) {
  const bool is_asked_to_end = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;
  if (is_asked_to_end && !g_interrupted.exchange(true)) return TRUE;
  leave_console();
  return FALSE;
}

/// A variable of the environment; empty where it is not set.
std::wstring variable(const wchar_t* name) {
  std::wstring value(GetEnvironmentVariableW(name, nullptr, 0), L'\0');
  if (value.empty()) return value;
  value.resize(GetEnvironmentVariableW(name, value.data(), static_cast<DWORD>(value.size())));
  return value;
}

}  // namespace

std::string utf8_of(std::wstring_view text) {
  const int from = static_cast<int>(text.size());
  const int size = WideCharToMultiByte(CP_UTF8, 0, text.data(), from, nullptr, 0, nullptr, nullptr);
  std::string out(static_cast<size_t>(size), '\0');
  WideCharToMultiByte(CP_UTF8, 0, text.data(), from, out.data(), size, nullptr, nullptr);
  return out;
}

// Ignores argv, which is in the old code page and cannot hold most names.
std::vector<std::string> command_line(int, const char* const*) {
  int count = 0;
  wchar_t** words = CommandLineToArgvW(GetCommandLineW(), &count);
  std::vector<std::string> out;
  for (int i = 1; i < count; ++i) out.push_back(utf8_of(words[i]));
  LocalFree(words);
  return out;
}

Console::Console() {
  // The C library writes to a console byte by byte if it may, and a character must not be cut.
  constexpr size_t kBuffer = size_t{1} << 16;
  for (std::FILE* file : {stdout, stderr}) {
    _setmode(_fileno(file), _O_BINARY);
    std::setvbuf(file, nullptr, _IOFBF, kBuffer);
  }
  g_code_page = GetConsoleOutputCP();
  if (g_code_page != 0) SetConsoleOutputCP(CP_UTF8);
}

Console::~Console() { leave_console(); }

bool is_error_terminal() {
  DWORD modes = 0;
  return GetConsoleMode(GetStdHandle(STD_ERROR_HANDLE), &modes) != 0;
}

void note_interrupts() { SetConsoleCtrlHandler(on_control, TRUE); }
bool is_interrupted() { return g_interrupted; }

fs::path user_cache_folder() {
  const fs::path folder = variable(L"LOCALAPPDATA");
  return folder.is_absolute() ? folder / "vkhausdorff" : fs::path();
}

std::string host_name() {
  std::array<wchar_t, MAX_COMPUTERNAME_LENGTH + 1> name{};
  DWORD length = static_cast<DWORD>(name.size());
  return GetComputerNameW(name.data(), &length) != 0 ? name_of(fs::path(name.data())) : "";
}

std::string processor_name() {
  std::array<wchar_t, 256> name{};
  const DWORD length = GetEnvironmentVariableW(L"PROCESSOR_IDENTIFIER", name.data(),
                                               static_cast<DWORD>(name.size()));
  const bool is_known = length > 0 && length < name.size();
  return is_known ? name_of(fs::path(name.data())) : "unknown processor";
}

void call_in_forks(void (*)()) {}

unsigned long process_id() { return GetCurrentProcessId(); }

// Avoids ExitProcess, which _Exit calls: it ends the other threads first, then notifies every
// library, and may wait forever for a lock that one of those threads held.
void end_process(int code) {
  TerminateProcess(GetCurrentProcess(), static_cast<UINT>(code));
  std::abort();  // TerminateProcess does not return
}

// Keeps the thread joinable, and does not detach it. In winpthreads of mingw-w64 10, detaching a
// thread that has just ended may free its entry while the thread still uses it: a later thread that
// gets the entry never runs its work (docs/platforms.md).
void leave_thread(std::thread thread) {
  new std::thread(std::move(thread));  // lives as long as the program
}

}  // namespace vkh
