// Running a program without a shell: no file name can be mistaken for a command.
#include "program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

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

}  // namespace feeler::demo
