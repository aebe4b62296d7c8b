#include "FarOptions.h"

#include "ByteSize.h"

#include <cstdlib>
#include <string>

namespace pointfront
{

void declareFarOptions(CLI::App& command)
{
  const auto setSize = [](const std::string& text)
  {
    const auto bytes = parseByteSize(text);
    if (!bytes && text != "0")
    {
      throw CLI::ValidationError("--cache-size", text + ": a size is 512M, 4G; 0 switches it off");
    }
    ::setenv("POINTFRONT_CACHE_SIZE", std::to_string(bytes.value_or(0)).c_str(), 1);
  };
  command
    .add_option_function<std::string>("--cache-size", setSize,
      "Of what addresses have given, kept on the disk (4G, at most a tenth of the free space; 0: "
      "nothing)")
    ->type_name("BYTES");
  command.add_flag_callback(
    "--offline", [] { ::setenv("POINTFRONT_OFFLINE", "1", 1); },
    "Ask no server: addresses give what the cache has");
}

void addTraffic(nlohmann::ordered_json& statistics)
{
  addTraffic(statistics, ByteTraffic::ofProcess().counts());
}

void addTraffic(nlohmann::ordered_json& statistics, const TrafficCounts& traffic)
{
  statistics["requests"] = traffic.requests;
  statistics["bytes_fetched"] = traffic.bytes;
  statistics["retries"] = traffic.retries;
  statistics["cache_hits"] = traffic.cacheHits;
  statistics["cache_bytes"] = traffic.cacheBytes;
}

std::string trafficText(const TrafficCounts& traffic)
{
  const bool one = traffic.requests == 1;
  return "\n  traffic     " + std::to_string(traffic.requests) +
    (one ? " request, " : " requests, ") + byteSizeText(traffic.bytes) + " fetched, " +
    byteSizeText(traffic.cacheBytes) + " from the cache" +
    (traffic.retries > 0 ? ", " + std::to_string(traffic.retries) + " retries" : "");
}

} // namespace pointfront
