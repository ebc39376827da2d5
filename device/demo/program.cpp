// Running a program without a shell: no file name can be mistaken for a command.
#include "program.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace feeler::demo {

int run_program(const std::filesystem::path& folder, const std::vector<std::string>& command) {
  constexpr int not_run = 127;
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  const pid_t child = fork();
  if (child < 0) return not_run;
  if (child == 0) {
    // Only calls that are safe after a fork, until the program takes over.
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDIN_FILENO);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    if (chdir(folder.c_str()) == 0) execvp(arguments[0], arguments.data());
    _exit(not_run);
  }
  int status = 0;
  if (waitpid(child, &status, 0) != child || !WIFEXITED(status)) return not_run;
  return WEXITSTATUS(status);
}

}  // namespace feeler::demo
