// Running a program without a shell: no file name can be mistaken for a command.
#include "program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <memory>

namespace feeler::demo {

namespace {

constexpr int not_run = 127;

std::vector<char*> arguments_of(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  return arguments;
}

// Only calls that are safe after a fork, until the program takes over.
[[noreturn]] void become(const char* folder, char* const* arguments) {
  const int nowhere = open("/dev/null", O_RDWR);
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(nowhere, STDERR_FILENO);
  for (int file = 3; file < 1024; ++file) close(file);  // a browser that kept our socket would keep our port
  if (chdir(folder) == 0) execvp(arguments[0], arguments);
  _exit(not_run);
}

/// Leaves it a zombie, so that whoever kills it kills no other program of its number.
void wait_or_kill(pid_t child, const std::stop_token& stop) {
  const std::stop_callback kills(stop, [child] { kill(child, SIGKILL); });
  siginfo_t info;
  while (waitid(P_PID, id_t(child), &info, WEXITED | WNOWAIT) != 0 && errno == EINTR) {}
}

}  // namespace

int run_program(const std::filesystem::path& folder, const std::vector<std::string>& command) {
  const std::vector<char*> arguments = arguments_of(command);
  const pid_t child = fork();
  if (child < 0) return not_run;
  if (child == 0) become(folder.c_str(), arguments.data());
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return not_run;
  return WEXITSTATUS(status);
}

void start_program(const std::vector<std::string>& command) {
  const std::vector<char*> arguments = arguments_of(command);
  const pid_t child = fork();
  if (child < 0) return;
  if (child == 0) {
    // Its parent ends at once, so that nobody has to wait for it.
    if (fork() == 0) become(".", arguments.data());
    _exit(0);
  }
  waitpid(child, nullptr, 0);
}

std::optional<std::string> filter(const std::vector<std::string>& command, const std::string& input, const std::stop_token& stop) {
  auto closed = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(closed)> in(std::tmpfile(), closed), out(std::tmpfile(), closed);
  if (!in || !out || std::fwrite(input.data(), 1, input.size(), in.get()) != input.size()) return {};
  std::rewind(in.get());
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, fileno(in.get()), STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(out.get()), STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&actions, 3);
  const std::vector<char*> arguments = arguments_of(command);
  pid_t child = 0;
  // No fork: the servo loop would have to wait for its own pages.
  const bool has_begun = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ) == 0;
  posix_spawn_file_actions_destroy(&actions);
  if (has_begun) wait_or_kill(child, stop);
  int status = 0;
  if (!has_begun || waitpid(child, &status, 0) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0) return {};
  std::string output;
  std::rewind(out.get());
  char piece[65536];
  while (const std::size_t size = std::fread(piece, 1, sizeof piece, out.get())) output.append(piece, size);
  return output;
}

}  // namespace feeler::demo
