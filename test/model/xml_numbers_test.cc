#include "core/model/xml/xml_numbers.h"

#include <gmock/gmock.h>

namespace armloom {
namespace {

TEST(XmlNumbers, ReadsDecimalNumbersExactly) {
  EXPECT_EQ(parse_number("0"), 0.0);
  EXPECT_EQ(parse_number("-1.5"), -1.5);
  EXPECT_EQ(parse_number("+.25"), 0.25);
  EXPECT_EQ(parse_number("3.0E-4"), 3e-4);
}

TEST(XmlNumbers, RejectsInvalidNumbers) {
  for (const char* token :
       {"",     "nan", "NaN", "inf", "-inf", "infinity", "1e999", "-1e999", "0x10", "1,5",
        "1.5m", " 1",  "1 ",  "--1", "+-1",  "-+1",      "1e",    "e5",     ".",    "${pi}"}) {
    EXPECT_EQ(parse_number(token), std::nullopt) << token;
  }
}

TEST(XmlNumbers, ListsAcceptAnyWhiteSpace) {
  EXPECT_THAT(parse_numbers("  1\t2\r\n 3 "), testing::Optional(testing::ElementsAre(1, 2, 3)));
  EXPECT_THAT(parse_numbers(""), testing::Optional(testing::IsEmpty()));
  EXPECT_EQ(parse_numbers("1 2 x"), std::nullopt);
}

}  // namespace
}  // namespace armloom
