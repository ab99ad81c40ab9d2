#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <atomic>
#include <cstdio>

#include "host/system/system.h"
#include "host/system/windows_text.h"

namespace vkh {
namespace {

namespace fs = std::filesystem;

// What the console was like, for it outlives the program.
struct ConsoleState {
  UINT code_page = 0;     ///< 0: not changed
  DWORD error_modes = 0;  ///< of standard error, where that is a console
  bool is_error_console = false, can_redraw = false;
};
ConsoleState g_console;

HANDLE error_handle() { return GetStdHandle(STD_ERROR_HANDLE); }

void leave_console() {
  if (g_console.code_page != 0) SetConsoleOutputCP(g_console.code_page);
  if (g_console.is_error_console) SetConsoleMode(error_handle(), g_console.error_modes);
  g_console = {};
}

std::atomic<bool> g_interrupted = false;

// Called on a thread of its own. False: the default handler ends the program.
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

const char* const kVulkanLoader = "vulkan-1.dll: install your graphics card's driver";

std::string utf8_of(std::wstring_view text) {
  const int from = static_cast<int>(text.size());
  const int size = WideCharToMultiByte(CP_UTF8, 0, text.data(), from, nullptr, 0, nullptr, nullptr);
  std::string out(static_cast<size_t>(size), '\0');
  WideCharToMultiByte(CP_UTF8, 0, text.data(), from, out.data(), size, nullptr, nullptr);
  return out;
}

// argv is in the code page of old, where most names cannot be said.
std::vector<std::string> command_line(int, const char* const*) {
  int count = 0;
  wchar_t** words = CommandLineToArgvW(GetCommandLineW(), &count);
  std::vector<std::string> out;
  for (int i = 1; i < count; ++i) out.push_back(utf8_of(words[i]));
  LocalFree(words);
  return out;
}

Console::Console() {
  for (std::FILE* file : {stdout, stderr}) _setmode(_fileno(file), _O_BINARY);
  g_console.code_page = GetConsoleOutputCP();
  if (g_console.code_page != 0) SetConsoleOutputCP(CP_UTF8);
  g_console.is_error_console = GetConsoleMode(error_handle(), &g_console.error_modes) != 0;
  g_console.can_redraw =
      g_console.is_error_console &&
      SetConsoleMode(error_handle(), g_console.error_modes | ENABLE_PROCESSED_OUTPUT |
                                         ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

Console::~Console() { leave_console(); }

bool can_redraw_errors() { return g_console.can_redraw; }

void note_interrupts() { SetConsoleCtrlHandler(on_control, TRUE); }
bool is_interrupted() { return g_interrupted; }

fs::path user_cache_folder() {
  const fs::path folder = variable(L"LOCALAPPDATA");
  return folder.is_absolute() ? folder / "vkhausdorff" : fs::path();
}

unsigned long process_id() { return GetCurrentProcessId(); }

AnyFunction vulkan_loader_function(const char* name) {
  // From the program's folder or Windows' own, not from the one that it is run in.
  const HMODULE library =
      LoadLibraryExW(L"vulkan-1.dll", nullptr, LOAD_LIBRARY_SEARCH_DEFAULT_DIRS);
  return library == nullptr ? nullptr
                            : reinterpret_cast<AnyFunction>(GetProcAddress(library, name));
}

}  // namespace vkh
