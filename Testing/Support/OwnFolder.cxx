// Linked into every program of tests: testing::TempDir() is a folder of this process alone. ctest
// runs the tests of one program side by side, each in a process of its own, and two of them that
// write a file of one name read each other's half.

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>
#include <unistd.h>

namespace
{
class OwnFolder
{
public:
  OwnFolder()
  {
    const char* const shared = std::getenv("TEST_TMPDIR");
    const std::filesystem::path parent =
      shared && *shared ? std::filesystem::path(shared) : std::filesystem::temp_directory_path();
    folder_ = parent / ("process-" + std::to_string(owner_));
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    ::setenv("TEST_TMPDIR", folder_.c_str(), 1);
  }
  ~OwnFolder()
  {
    // A copy of the process, made by fork(), may end before the process does.
    if (::getpid() == owner_)
    {
      std::error_code ignored;
      std::filesystem::remove_all(folder_, ignored);
    }
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;

private:
  ::pid_t owner_ = ::getpid();
  std::filesystem::path folder_;
};

const OwnFolder ownFolder;
} // namespace
