#include "StoreInTheMaking.h"

#include "pointfront/Store/PreviewRecord.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace pointfront
{

namespace
{
namespace fs = std::filesystem;

Error failed(const std::string& what)
{
  return makeError(Error::Kind::Unwritable, what + ": " + std::strerror(errno));
}
} // namespace

Result<std::unique_ptr<StoreInTheMaking>> StoreInTheMaking::begin(
  const std::vector<std::string>& files, const std::string& keep)
{
  std::unique_ptr<StoreInTheMaking> made(new StoreInTheMaking);
  std::error_code failure;
  std::string folder = (fs::temp_directory_path(failure) / "pointfront-view-XXXXXX").string();
  if (failure || ::mkdtemp(folder.data()) == nullptr)
  {
    return failed(folder + ": cannot make the folder");
  }
  made->folder_ = folder;
  made->store_ =
    keep.empty() ? folder + "/" + fs::path(files.front()).stem().string() + ".pfront" : keep;
  if (Result<void> started = made->start(files); !started)
  {
    return started.error();
  }
  return made;
}

Result<void> StoreInTheMaking::start(const std::vector<std::string>& files)
{
  std::vector<std::string> words{ "pointfront", "build" };
  words.insert(words.end(), files.begin(), files.end());
  words.insert(words.end(), { "-o", store_, "--progress", "none" });
  std::vector<char*> arguments;
  for (std::string& word : words)
  {
    arguments.push_back(word.data());
  }
  arguments.push_back(nullptr);
  const std::string log = folder_ + "/log";
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0)
  {
    return failed("no process for the build");
  }
  if (process_ == 0) // a child process may call async-signal-safe functions only
  {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM); // however the window ends, the build does
    const int output = ::open(log.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    if (::getppid() == parent && output >= 0 && ::dup2(output, STDOUT_FILENO) >= 0 &&
      ::dup2(output, STDERR_FILENO) >= 0)
    {
      ::execv("/proc/self/exe", arguments.data());
    }
    ::_exit(127);
  }
  return {};
}

StoreInTheMaking::~StoreInTheMaking()
{
  if (process_ > 0)
  {
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }
  std::error_code ignored;
  if (!folder_.empty())
  {
    fs::remove_all(folder_, ignored);
  }
}

StoreInTheMaking::State StoreInTheMaking::look()
{
  int status = 0;
  if (process_ > 0 && ::waitpid(process_, &status, WNOHANG) == process_)
  {
    process_ = -1;
    state_ = WIFEXITED(status) && WEXITSTATUS(status) == 0 ? State::Whole : State::Failed;
  }
  std::error_code failure;
  if (state_ == State::Reading && fs::exists(previewPathOf(store_), failure))
  {
    state_ = State::Preview;
  }
  return state_;
}

std::string StoreInTheMaking::path() const
{
  return state_ == State::Preview ? previewPathOf(store_) : store_;
}

std::string StoreInTheMaking::failure() const
{
  std::ifstream log(folder_ + "/log");
  std::string last = "pointfront build: it was ended";
  for (std::string line; std::getline(log, line);)
  {
    last = line.find("warning:") == std::string::npos && !line.empty() ? line : last;
  }
  return last;
}

} // namespace pointfront
