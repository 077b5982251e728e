// SPDX-License-Identifier: MIT
#include "touchstone/tests/tools/program.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace touchstone {
namespace {

namespace fs = std::filesystem;

std::string ReadFile(const fs::path& path) {
  std::ostringstream content;
  content << std::ifstream(path).rdbuf();
  return content.str();
}

int ExitCodeOf(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

ProgramRun RunProgram(const std::string& arguments) {
  const TemporaryFolder folder("run");
  const std::string out = folder.path("out");
  const std::string err = folder.path("err");
  const std::string command =
      std::string(TOUCHSTONE_PROGRAM) + " " + arguments + " >" + out + " 2>" + err;
  const int status = std::system(command.c_str());
  return {ExitCodeOf(status), ReadFile(out), ReadFile(err)};
}

Background::Background(const std::string& command) : pid_(fork()) {
  if (pid_ != 0) return;
  execl("/bin/sh", "sh", "-c", ("exec " + command).c_str(), nullptr);
  _exit(127);
}

Background::~Background() {
  if (has_ended()) return;
  Signal(SIGKILL);
  Wait();
}

void Background::Signal(int signal) const {
  if (!ended_) kill(pid_, signal);
}

bool Background::has_ended() {
  ended_ = ended_ || waitpid(pid_, &status_, WNOHANG) == pid_;
  return ended_;
}

int Background::Wait() {
  if (!ended_) ended_ = waitpid(pid_, &status_, 0) == pid_;
  return ExitCodeOf(status_);
}

TemporaryFolder::TemporaryFolder(std::string_view name) {
  static int counter = 0;
  path_ = fs::temp_directory_path() / ("touchstone_" + std::string(name) + "_" +
                                       std::to_string(getpid()) + "_" + std::to_string(counter++));
  fs::create_directories(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string TemporaryFolder::Write(std::string_view file, std::string_view content) const {
  std::ofstream(path_ / file, std::ios::binary) << content;
  return path(file);
}

std::string TemporaryFolder::Read(std::string_view file) const { return ReadFile(path_ / file); }

}  // namespace touchstone
