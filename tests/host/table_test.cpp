// SPDX-License-Identifier: MIT
// Numbers as text, and CSV tables.
#include <gtest/gtest.h>

#include <cmath>

#include "common/csv.hpp"
#include "common/text.hpp"
#include "expect_input_error.hpp"
#include "temp_folder.hpp"

namespace {

using host_test::expectInputError;

host::CsvTable table(const std::string& text) {
  const host_test::TempFolder folder;
  return host::readCsv(folder.write("t.csv", text), {{"a"}, {"a", "b"}});
}

TEST(HostText, ReadsBackWhatItPrints) {
  for (const double x : {0.1, -1.0 / 3.0, 5e-324, 1.7976931348623157e308, 0.0, 123456789.123}) {
    EXPECT_EQ(host::parseNumber(host::formatNumber(x)), x);
  }
  EXPECT_EQ(host::parseNumber(" +2.5e1 "), 25.0);
  EXPECT_EQ(host::parseNumber("inf"), INFINITY);
  for (const char* text : {"", "nan", "1,5", "1 2", "0x", "1e", "--1", "+-1", "1e999", "one"}) {
    EXPECT_FALSE(host::parseNumber(text).has_value()) << text;
  }
}

TEST(HostCsv, NamesColumnsFromTheHeaderOrByCount) {
  const host::CsvTable named = table("# comment\n b , a \n1,2\r\n\n3,4");
  EXPECT_EQ(named.rowCount(), 2u);
  EXPECT_EQ(named.at(1, named.find("a")), 4.0);
  const host::CsvTable bare = table("1,2\n3,4\n");
  EXPECT_EQ(bare.at(0, bare.find("b")), 2.0);
  EXPECT_EQ(bare.find("c"), -1);
}

TEST(HostCsv, NamesLineAndColumnOfAMistake) {
  expectInputError("line 3, column b: expected a number, got 'x'",
                   [] { table("a,b\n1,2\n3,x\n"); });
  expectInputError("line 2, column a: expected a number, got 'nan'", [] { table("a\nnan\n"); });
  expectInputError("line 3: expected 2 columns, got 1", [] { table("a,b\n1,2\n3\n"); });
  expectInputError("expected the columns a or a,b", [] { table("1,2,3\n"); });
  expectInputError("at least one row", [] { table(""); });
}

TEST(HostCsv, KeepsEveryDigit) {
  const host_test::TempFolder folder;
  const std::vector<double> values = {0.1, 1.0 / 3.0, -2.2250738585072014e-308, INFINITY};
  host::writeCsv(folder.file("o.csv"), {"a", "b"}, values);
  EXPECT_EQ(host::readCsv(folder.file("o.csv"), {}).values, values);
}

}  // namespace
