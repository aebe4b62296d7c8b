#include "AnswerHeaders.h"

#include <gtest/gtest.h>

namespace pointfront
{

TEST(AnswerHeaders, OnlyAPromiseOfASoundLengthCounts)
{
  const auto seconds = [](const char* control, const char* age = "")
  {
    HttpAnswer answer;
    answer.headers = { { "cache-control", control }, { "age", age } };
    return unchangedFor(answer).count();
  };
  EXPECT_EQ(seconds("public, max-age=31536000, immutable"), 31536000);
  EXPECT_EQ(seconds("Immutable ,Max-Age = \"60\""), 60);
  EXPECT_EQ(seconds("max-age=60, immutable", "50"), 10);
  EXPECT_EQ(seconds("max-age=60, immutable", "60"), 0);
  EXPECT_EQ(seconds("max-age=60, immutable", "soon"), 0);
  EXPECT_EQ(seconds("max-age=60"), 0) << "it may be another file by now";
  EXPECT_EQ(seconds("immutable"), 0);
  EXPECT_EQ(seconds("max-age=-1, immutable"), 0);
  EXPECT_EQ(seconds("max-age=6e1, immutable"), 0);
  EXPECT_EQ(seconds("max-age=99999999999999999999, immutable"), 0);
  EXPECT_EQ(seconds("max-age=9999999999999, immutable"), 366 * 24 * 3600);
  EXPECT_EQ(seconds("max-age=60, immutable, no-cache"), 0);
  EXPECT_EQ(seconds("no-store, max-age=60, immutable"), 0);
  EXPECT_EQ(seconds("s-maxage=60, immutable"), 0);
  EXPECT_EQ(seconds(""), 0);
  EXPECT_EQ(unchangedFor(HttpAnswer()).count(), 0);
}

TEST(AnswerHeaders, PausesAreNoLongerThanHalfAMinute)
{
  const auto seconds = [](const char* text)
  {
    HttpAnswer answer;
    answer.headers = { { "retry-after", text } };
    return std::chrono::duration_cast<std::chrono::seconds>(askedPause(answer)).count();
  };
  EXPECT_EQ(seconds("7"), 7);
  EXPECT_EQ(seconds("99999999999999999999"), 30);
  EXPECT_EQ(seconds("-5"), 0);
  EXPECT_EQ(seconds("Fri, 27 Nov 2026 08:00:00 GMT"), 0);
}

TEST(AnswerHeaders, AFaultIsNamedByPlainWordsOnly)
{
  HttpAnswer answer;
  EXPECT_EQ(faultCode(answer) + bucketRegion(answer), "");
  answer.words = "<Error><Code>Some-Code</Code><Region>eu-west-1</Region></Error>";
  EXPECT_EQ(faultCode(answer), "Some-Code");
  EXPECT_EQ(bucketRegion(answer), "eu-west-1");
  answer.headers["x-amz-bucket-region"] = "us-west-2";
  EXPECT_EQ(bucketRegion(answer), "us-west-2");
  answer.headers["x-amz-bucket-region"] = "us; rm -rf";
  EXPECT_EQ(bucketRegion(answer), "eu-west-1");
  for (const char* const words : { "<Code>", "<Code>cut off", "<Code>two words</Code>",
         "<Code>\x1b[2J</Code>", "<code>x</code>" })
  {
    answer.words = words;
    EXPECT_EQ(faultCode(answer), "") << words;
  }
}

} // namespace pointfront
