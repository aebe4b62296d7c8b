#include "CloudFormats.h"

#include "COPCFile.h"
#include "EPTTree.h"
#include "IndexedLASFile.h"
#include "LASFormat.h"
#include "LAZGlance.h"
#include "NormalsOnLoad.h"

#ifdef POINTFRONT_REMOTE
#include "Credentials.h"
#include "RemoteOpener.h"
#endif

#include "pointfront/Tiles/StoredCloudFormats.h"

#include <memory>
#include <string>

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

} // namespace pointfront
