#include "pointfront/Disk/ByteOpeners.h"

#include <gtest/gtest.h>

#include <string>

namespace pointfront
{
namespace
{
/// Why the list may not name it; "": it may.
std::string refusal(const std::string& list, const std::string& name)
{
  const Result<std::string> file = fileNamedBy(list, name);
  EXPECT_TRUE(file || file.error().kind == Error::Kind::Unsupported) << name;
  return file ? std::string() : file.error().what;
}
} // namespace

TEST(NamedFile, AListBehindAnAddressNamesNoFileOfThisMachine)
{
  EXPECT_EQ(fileNamedBy("a/l.pfronts", "b.pfront").value(), "a/b.pfront");
  EXPECT_EQ(fileNamedBy("a/l.pfronts", "/b.pfront").value(), "/b.pfront");
  EXPECT_EQ(fileNamedBy("https://h/a/l.pfronts", "b c.pfront").value(), "https://h/a/b%20c.pfront");
  EXPECT_EQ(fileNamedBy("https://h/a/l.pfronts", "s3://b/c").value(), "s3://b/c");
  for (const char* name : { "/etc/passwd", "file:///etc/passwd", "FILE:///etc/passwd" })
  {
    const std::string why = refusal("https://h/a/l.pfronts", name);
    EXPECT_EQ(why.find("https://h/a/l.pfronts: names the file '/etc/passwd'"), 0u) << why;
    EXPECT_NE(why.find("names addresses"), std::string::npos) << why;
  }
}

TEST(NamedFile, AListBehindAnAddressSetsNothing)
{
  for (const char* name :
    { "b#far:cache=/tmp", "https://me:secret@g/b?sig=secret#far:cache=/tmp",
      "https://g/b#epoch=1#far:offline=1", "b#epoch=#far:timeout=1", "b#far:", "#far:offline=1" })
  {
    const std::string why = refusal("https://h/l.pfronts", name);
    EXPECT_NE(why.find("https://h/l.pfronts: names '"), std::string::npos) << name << ": " << why;
    EXPECT_NE(why.find("settings"), std::string::npos) << name << ": " << why;
    EXPECT_EQ(why.find("sig=secret"), std::string::npos) << why;
  }
  // The user has written a list on this machine, and a path is a path.
  EXPECT_EQ(
    fileNamedBy("l.pfronts", "https://g/b#far:offline=1").value(), "https://g/b#far:offline=1");
  EXPECT_EQ(fileNamedBy("l.pfronts", "b#far:offline=1").value(), "b#far:offline=1");
}

TEST(NamedFile, FilesThatProgramsWriteHaveNoSettings)
{
  EXPECT_FALSE(refuseSettings("a.pfcollection", "https://g/b#far:offline=1"));
  EXPECT_FALSE(refuseSettings("https://h/a.pfcollection", "b#far:offline=1"));
  EXPECT_TRUE(refuseSettings("a.pfcollection", "b#far:offline=1")); // the name of a file
  EXPECT_TRUE(refuseSettings("https://h/a.pfcollection", "https://g/b?sig=1#epoch=far"));
}

} // namespace pointfront
