#include "CloudFormats.h"

#include "COPCFile.h"
#include "EPTTree.h"
#include "IndexedLASFile.h"
#include "LASFormat.h"
#include "LAZGlance.h"
#include "NormalsOnLoad.h"
#include "STACFormat.h"

#ifdef POINTFRONT_REMOTE
#include "Address.h"
#include "Credentials.h"
#include "RemoteOpener.h"
#endif

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

void addCloudFormats()
{
#ifdef POINTFRONT_REMOTE
  addRemoteOpeners();
#endif
  StoredCloudFormats& formats = StoredCloudFormats::ofProcess();
  formats.add(withNormalsOnLoad(std::make_shared<LASIndexFormat>()));
  formats.add(withNormalsOnLoad(std::make_shared<COPCFormat>()));
  formats.add(withNormalsOnLoad(std::make_shared<EPTTreeFormat>(&LASFormat::openBytes)));
  formats.add(std::make_shared<STACFormat>());
  formats.add(std::make_shared<LAZGlanceFormat>()); // last: a folder with nothing better in it
}

Result<void> learnCredentialsOfServers([[maybe_unused]] const std::string& text)
{
#ifdef POINTFRONT_REMOTE
  addRemoteOpeners(); // the environment comes first
  return learnCredentials(text);
#else
  return makeError(Error::Kind::Unsupported,
    "this build opens files only (POINTFRONT_REMOTE=OFF): it has no use for headers and tokens");
#endif
}

std::string credentialsForChild([[maybe_unused]] const std::vector<std::string>& words)
{
  const char* const given = std::getenv("POINTFRONT_FAR");
  std::string text = given != nullptr ? given : "";
#ifdef POINTFRONT_REMOTE
  for (const std::string& word : words)
  {
    const std::size_t query = isAddress(word) ? word.find("?~") : std::string::npos;
    const std::string whole = query != std::string::npos ? addressOf(word) : word;
    text += whole != word ? "\n" + word.substr(query + 1) + ' ' + whole : "";
  }
#endif
  return text;
}

} // namespace pointfront
