#pragma once

#include "HttpTransfer.h"

#include <curl/curl.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pointfront
{

/// A question on its way. The library has its address, so that it stays where it is.
class Transfer
{
public:
  /// Errors  std::bad_alloc.
  Transfer(std::string line, const HttpQuestion& question, HttpAnswer& answer);
  ~Transfer();
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  const std::string& line() const { return line_; }
  HttpAnswer& answer() const { return *answer_; }
  CURL* easy() const { return easy_; }
  /// Fills the answer from how the transfer ended.
  void conclude(CURLcode code);

  /// Fills the answer of a transfer that nobody waits for any more with what has come.
  void giveUp();

  bool begun = false; ///< it has left its line's queue; guarded by the loop's lock
  bool over = false; ///< its answer is there; guarded by the loop's lock
  std::atomic<std::uint64_t> received{ 0 }; ///< bytes of the body that were wanted

  // For the library's callbacks.
  std::size_t takeHeader(std::string_view text);
  std::size_t takeBody(const char* data, std::size_t size);

private:
  void prepare();

  const std::string line_;
  const HttpQuestion* question_;
  HttpAnswer* answer_;
  CURL* easy_;
  curl_slist* headers_ = nullptr;
  char message_[CURL_ERROR_SIZE] = {};
  std::size_t headerBytes_ = 0;
  std::size_t unwanted_ = 0;
  bool tooMuch_ = false;
};

} // namespace pointfront
