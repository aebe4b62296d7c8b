#include "CertificateFile.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace pointfront
{

TEST(CertificateFile, AnotherSystemsFileOnlyWhereOnesOwnIsMissing)
{
  const std::filesystem::path folder =
    std::filesystem::path(testing::TempDir()) / "pointfront-certificates";
  std::filesystem::create_directories(folder);
  const std::string own = folder / "own.pem";
  const std::string second = folder / "second.pem";
  const std::string third = folder / "third.pem";
  std::filesystem::remove(own);
  std::ofstream(second) << "authorities";
  std::ofstream(third) << "authorities";
  EXPECT_EQ(certificatesInPlaceOf(own, { folder / "none.pem", second, third }), second);
  EXPECT_EQ(certificatesInPlaceOf(own, { folder, folder / "none.pem" }), "");
  EXPECT_EQ(certificatesInPlaceOf("", { second }), "") << "a library that reads no file";
  std::ofstream(own) << "authorities";
  EXPECT_EQ(certificatesInPlaceOf(own, { second }), "");
  std::filesystem::remove_all(folder);
}

TEST(CertificateFile, TheEnvironmentChoosesFirst)
{
  ::setenv("CURL_CA_BUNDLE", "", 1);
  ::setenv("SSL_CERT_FILE", "/nowhere/else.pem", 1);
  EXPECT_EQ(certificateFile(), "/nowhere/else.pem") << "an empty variable is none";
  ::setenv("CURL_CA_BUNDLE", "/nowhere/first.pem", 1);
  EXPECT_EQ(certificateFile(), "/nowhere/first.pem");
  ::unsetenv("CURL_CA_BUNDLE");
  ::unsetenv("SSL_CERT_FILE");
}

} // namespace pointfront
