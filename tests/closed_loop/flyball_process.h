// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "flyball_program.h"
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

/// The built command as a process that goes on while the test does something to it.
class FlyballProcess {
 public:
  /// @param ignored  Signals that it ignores, as nohup arranges it. Whoever runs the tests in the
  ///                 background may ignore others: here the rest has its usual effect.
  FlyballProcess(const FlyballProgram& program,
                 std::vector<std::string> words,
                 const std::vector<int>& ignored = {})
      : place_{program.place.path()} {
    words.insert(words.begin(), "flyball");
    std::vector<char*> argv;
    for (std::string& word : words) {
      argv.push_back(word.data());
    }
    argv.push_back(nullptr);
    id_ = fork();
    if (id_ == 0) {
      for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        std::signal(signal, SIG_DFL);
      }
      for (const int signal : ignored) {
        std::signal(signal, SIG_IGN);
      }
      dup2(open(said_.path("out").c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
      dup2(open(said_.path("err").c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
      if (chdir(place_.c_str()) == 0) {
        execv(FlyballProgram::binary().c_str(), argv.data());
      }
      _exit(127);
    }
  }
  FlyballProcess(const FlyballProcess&) = delete;
  FlyballProcess& operator=(const FlyballProcess&) = delete;
  ~FlyballProcess() {
    if (!has_ended_) {
      kill(id_, SIGKILL);
      (void)exit_code();
    }
  }

  /// Until it has written a file or folder; a failure if it ends before.
  void wait_for_file(const std::string& name) {
    wait_for([&] { return std::filesystem::exists(place_ + name); });
  }
  /// Until it has said so on standard error; a failure if it ends before.
  void wait_for_words(const std::string& words) {
    wait_for([&] { return errors().find(words) != std::string::npos; });
  }
  void send(int signal) const {
    if (!has_ended_) {
      kill(id_, signal);
    }
  }
  /// Waits for its end. The negative signal where one ended it.
  [[nodiscard]] int exit_code() {
    if (!has_ended_) {
      waitpid(id_, &status_, 0);
      has_ended_ = true;
    }
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
  }
  [[nodiscard]] std::vector<pid_t> children() const {
    std::vector<pid_t> found;
    for (const auto& entry : std::filesystem::directory_iterator{"/proc"}) {
      const std::string name = entry.path().filename();
      if (name.find_first_not_of("0123456789") == std::string::npos && parent_of(name) == id_) {
        found.push_back(std::stoi(name));
      }
    }
    return found;
  }
  /// A process that nobody has waited for yet has ended, too.
  static void wait_for_end(pid_t process) {
    for (char state = 'R'; state != 'Z' && state != 'X';) {
      std::ifstream file{"/proc/" + std::to_string(process) + "/stat"};
      std::string word;
      if (!(file >> word >> word >> state)) {
        return;
      }
      std::this_thread::yield();
    }
  }

  [[nodiscard]] std::string output() const { return said_.content("out"); }
  [[nodiscard]] std::string errors() const { return said_.content("err"); }

 private:
  template <class Condition>
  void wait_for(Condition holds) {
    while (!holds()) {
      if (waitpid(id_, &status_, WNOHANG) == id_) {
        has_ended_ = true;
        ADD_FAILURE() << "ended too early, status " << status_ << "\n" << errors();
        return;
      }
      std::this_thread::yield();
    }
  }
  static pid_t parent_of(const std::string& process) {
    std::ifstream file{"/proc/" + process + "/stat"};
    std::string word;
    char state{};
    pid_t parent{};
    return file >> word >> word >> state >> parent ? parent : 0;
  }

  std::string place_;
  ScratchFolder said_{};
  pid_t id_{};
  int status_{};
  bool has_ended_{};
};
