#include <gtest/gtest.h>
TEST(LowerBound, x) {}
