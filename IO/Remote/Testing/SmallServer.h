#pragma once

#include <algorithm>
#include <arpa/inet.h>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <mutex>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace pointfront
{

/// A server on this machine with one file, which gives ranges of it. For tests of what its client
/// does; bad weather is the whole tests'.
/// Threads  one for each connection; what is public from any.
class SmallServer
{
public:
  explicit SmallServer(std::string file)
    : file_(std::move(file))
  {
    ::setenv("POINTFRONT_CACHE", "off", 1);
    ::setenv("no_proxy", "*", 1);
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in here = {};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ::bind(socket_, reinterpret_cast<sockaddr*>(&here), sizeof here);
    ::listen(socket_, 64);
    socklen_t size = sizeof here;
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &size);
    port_ = ntohs(here.sin_port);
    accepting_ = std::thread([this] { accept(); });
  }
  ~SmallServer()
  {
    ::shutdown(socket_, SHUT_RDWR);
    accepting_.join();
    ::close(socket_);
    for (const int connection : connections_)
    {
      ::shutdown(connection, SHUT_RDWR);
    }
    for (std::thread& thread : threads_)
    {
      thread.join();
    }
  }
  SmallServer(const SmallServer&) = delete;
  SmallServer& operator=(const SmallServer&) = delete;

  std::string address(const std::string& name = "file") const
  {
    return "http://127.0.0.1:" + std::to_string(port_) + "/" + name;
  }

  std::atomic<bool> silent{ false }; ///< takes requests and answers none
  std::atomic<bool> refuses{ false }; ///< 503
  std::atomic<bool> countsFromFront{ false }; ///< 200 and the whole file for its last bytes
  std::atomic<unsigned> state{ 1 }; ///< another number is another file of the same length
  std::atomic<unsigned> requests{ 0 };
  std::atomic<unsigned> left{ 0 }; ///< connections that the client has closed
  std::chrono::milliseconds pause{ 0 }; ///< before an answer
  /// Answers a request instead of the file, if it gives anything. Set it before the first request.
  std::function<std::string(const std::string& target, const std::string& request)> instead;
  std::string filesHeaders; ///< further headers of the file's parts, each with its end of line

private:
  void accept()
  {
    for (int connection = ::accept(socket_, nullptr, nullptr); connection >= 0;
         connection = ::accept(socket_, nullptr, nullptr))
    {
      connections_.push_back(connection);
      threads_.emplace_back([this, connection] { serve(connection); });
    }
  }
  void serve(int connection)
  {
    std::string text;
    char piece[4096];
    for (ssize_t size = ::recv(connection, piece, sizeof piece, 0); size > 0;
         size = ::recv(connection, piece, sizeof piece, 0))
    {
      text.append(piece, static_cast<std::size_t>(size));
      if (text.find("\r\n\r\n") != std::string::npos)
      {
        ++requests;
        if (!silent)
        {
          std::this_thread::sleep_for(pause);
          const std::string answer = answerTo(text);
          ::send(connection, answer.data(), answer.size(), MSG_NOSIGNAL);
        }
        text.clear();
      }
    }
    ++left;
    ::close(connection);
  }
  std::string answerTo(const std::string& request) const
  {
    if (refuses)
    {
      return "HTTP/1.1 503 no\r\nContent-Length: 0\r\n\r\n";
    }
    if (instead)
    {
      const std::size_t target = request.find(' ') + 1;
      const std::string answer =
        instead(request.substr(target, request.find(' ', target) - target), request);
      if (!answer.empty())
      {
        return answer;
      }
    }
    std::size_t first = 0;
    std::size_t last = 0;
    const std::size_t at = request.find("Range: bytes=");
    if (std::sscanf(request.c_str() + at, "Range: bytes=-%zu", &last) == 1)
    {
      if (countsFromFront)
      {
        return "HTTP/1.1 200 all\r\nETag: \"" + std::to_string(state) +
          "\"\r\nContent-Length: " + std::to_string(file_.size()) + "\r\n\r\n" + file_;
      }
      first = file_.size() - std::min(last, file_.size());
      last = file_.size() - 1;
    }
    else if (std::sscanf(request.c_str() + at, "Range: bytes=%zu-%zu", &first, &last) != 2)
    {
      return "HTTP/1.1 400 no\r\nContent-Length: 0\r\n\r\n";
    }
    last = std::min(last, file_.size() - 1);
    const std::string body = file_.substr(first, last - first + 1);
    return "HTTP/1.1 206 part\r\nETag: \"" + std::to_string(state) +
      "\"\r\nContent-Length: " + std::to_string(body.size()) + "\r\nContent-Range: bytes " +
      std::to_string(first) + "-" + std::to_string(last) + "/" + std::to_string(file_.size()) +
      "\r\n" + filesHeaders + "\r\n" + body;
  }

  const std::string file_;
  int socket_ = -1;
  unsigned port_ = 0;
  std::thread accepting_;
  std::vector<int> connections_; ///< used by the accepting thread, and then by the destructor
  std::vector<std::thread> threads_; ///< likewise
};

} // namespace pointfront
