#include "Credentials.h"

#include "Address.h"

#include "pointfront/Threads/ForkHold.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <map>
#include <sstream>
#include <utility>

namespace pointfront
{
namespace
{
using Headers = std::map<std::string, std::vector<std::string>>; ///< by origin

Headers& headersOfProcess(const ForkHold&)
{
  static auto* const headers = new Headers; // never deleted: static objects may use it
  return *headers;
}

/// "Name: value"; nothing in it begins another line of a request.
bool isHeader(const std::string& line)
{
  const std::size_t colon = line.find(':');
  return colon != std::string::npos && colon > 0 && line.find_first_of(" \t") > colon &&
    std::none_of(line.begin(), line.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

Error wrongLine(std::size_t number)
{
  return makeError(Error::Kind::BadArgument,
    "line " + std::to_string(number) +
      " of what was said of servers (POINTFRONT_FAR) is neither a server in brackets, nor "
      "a header below one, nor a mark and an address");
}
} // namespace

Result<void> learnCredentials(const std::string& text)
{
  Headers headers;
  std::vector<std::string>* server = nullptr;
  std::istringstream in(text);
  std::size_t number = 0;
  for (std::string line; std::getline(in, line);)
  {
    ++number;
    if (line.empty())
    {
      continue;
    }
    if (line.front() == '[' && line.back() == ']')
    {
      const Result<Address> address = Address::parse(line.substr(1, line.size() - 2));
      if (!address || address->path != "/")
      {
        return wrongLine(number);
      }
      server = &headers[address->origin()];
      server->clear();
      continue;
    }
    const std::string mark = line.substr(0, line.find(' '));
    if (isMark(mark) && mark.size() + 1 < line.size())
    {
      const Result<Address> address = Address::parse(line.substr(mark.size() + 1));
      if (!address)
      {
        return wrongLine(number);
      }
      rememberAddress(*address, mark);
      continue;
    }
    if (server == nullptr || !isHeader(line))
    {
      return wrongLine(number);
    }
    server->push_back(line);
  }
  const ForkHold hold;
  for (auto& [origin, lines] : headers)
  {
    headersOfProcess(hold)[origin] = std::move(lines);
  }
  return {};
}

Result<void> learnCredentialsOfEnvironment()
{
  static std::atomic<bool> done{ false };
  const char* const text = done ? nullptr : std::getenv("POINTFRONT_FAR");
  const Result<void> learnt = text != nullptr ? learnCredentials(text) : Result<void>();
  done = done || learnt;
  return learnt;
}

std::vector<std::string> headersFor(const std::string& origin)
{
  const ForkHold hold;
  const Headers& headers = headersOfProcess(hold);
  const auto found = headers.find(origin);
  return found != headers.end() ? found->second : std::vector<std::string>();
}

} // namespace pointfront
