#include "ErrorObserver.h"

#include "vtkPointFrontReader.h"
#include "vtkPointFrontStore.h"

#include <vtkCommand.h>
#include <vtkNew.h>

#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <chrono>
#include <cstdlib>
#include <netinet/in.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace
{
using Clock = std::chrono::steady_clock;

/// A port of this machine that takes connections and says nothing.
class SilentPort
{
public:
  SilentPort()
  {
    sockaddr_in here = {};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(socket_, reinterpret_cast<sockaddr*>(&here), sizeof here);
    ::listen(socket_, 8);
    socklen_t size = sizeof here;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size);
    address_ = "http://127.0.0.1:" + std::to_string(ntohs(here.sin_port)) + "/a.pfront";
  }
  ~SilentPort() { ::close(socket_); }
  SilentPort(const SilentPort&) = delete;
  SilentPort& operator=(const SilentPort&) = delete;
  const std::string& address() const { return address_; }
  /// Waits for a client, ten seconds at most.
  bool hasClient() const
  {
    pollfd wanted = { socket_, POLLIN, 0 };
    return ::poll(&wanted, 1, 10000) == 1;
  }

private:
  const int socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  std::string address_;
};
} // namespace

TEST(FarReader, AnAbortEndsTheWaitForASilentServer)
{
  ::setenv("POINTFRONT_CACHE", "off", 1);
  ::setenv("no_proxy", "*", 1);
  const SilentPort silent;
  vtkNew<vtkPointFrontReader> reader;
  vtkNew<ErrorObserver> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  reader->SetFileName(silent.address().c_str());
  bool came = false;
  Clock::time_point aborted;
  std::thread user(
    [&]
    {
      came = silent.hasClient();
      aborted = Clock::now();
      reader->SetAbortExecute(1);
    });
  reader->UpdateInformation();
  const Clock::time_point ended = Clock::now();
  user.join();
  EXPECT_EQ(reader->GetStore(), nullptr);
  EXPECT_TRUE(errors->GetError());
  const bool filesOnly = errors->GetErrorMessage().find("does not open") != std::string::npos;
  EXPECT_TRUE(came || filesOnly); // in a build without addresses
  EXPECT_EQ(vtkPointFrontStore::GetNumberOfFarRequests() > 0, !filesOnly);
  EXPECT_EQ(vtkPointFrontStore::GetNumberOfFarBytes(), 0); // nothing came
  EXPECT_EQ(vtkPointFrontStore::GetNumberOfCachedBytes(), 0);
  EXPECT_LT(ended - aborted, std::chrono::seconds(1)); // 60 before
}

TEST(FarReader, HasSettingsOfItsOwn)
{
  const SilentPort silent;
  vtkNew<vtkPointFrontReader> reader;
  vtkNew<ErrorObserver> errors;
  reader->AddObserver(vtkCommand::ErrorEvent, errors);
  const auto error = [&]
  {
    errors->Clear();
    reader->Modified();
    reader->UpdateInformation();
    return errors->GetErrorMessage();
  };
  reader->SetFileName(silent.address().c_str());
  reader->SetTimeLimit(0.3);
  const Clock::time_point begin = Clock::now();
  const bool filesOnly = error().find("does not open") != std::string::npos;
  EXPECT_TRUE(errors->GetError());
  EXPECT_LT(Clock::now() - begin, std::chrono::seconds(20)); // 60 by the environment
  // A server that is not asked cannot be silent: the cache has nothing, or is none.
  const std::string folder = testing::TempDir() + "far-reader-cache";
  reader->SetOffline(1);
  reader->SetCacheFolder(folder.c_str());
  EXPECT_EQ(error().find("is not in the cache") == std::string::npos, filesOnly)
    << errors->GetErrorMessage();
  reader->SetCacheSize(0);
  EXPECT_NE(error().find("cache is off"), std::string::npos) << errors->GetErrorMessage();
  reader->SetCacheSize(-1);
  reader->SetFileName("a.pfront");
  EXPECT_NE(error().find("is a path"), std::string::npos) << errors->GetErrorMessage();
}
