#include "core/base/enumeration.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace armloom {
namespace {

enum class Fruit { apple, pear, plum };
constexpr const char* to_string(Fruit fruit) {
  switch (fruit) {
    case Fruit::apple:
      return "apple";
    case Fruit::pear:
      return "pear";
    case Fruit::plum:
      return "plum";
  }
  return nullptr;
}

static_assert(kValueCount<Fruit> == 3);
static_assert(kValues<Fruit>.back() == Fruit::plum);
static_assert(value_named<Fruit>("pear") == Fruit::pear);

TEST(Enumerations, ListAllValueNames) {
  std::set<std::string> names;
  for (const Fruit fruit : kValues<Fruit>) names.insert(to_string(fruit));
  EXPECT_EQ(names, (std::set<std::string>{"apple", "pear", "plum"}));
}

TEST(Enumerations, RejectUnknownNames) {
  for (const char* name : {"", "Apple", "appl", "apples", "0"}) {
    EXPECT_FALSE(value_named<Fruit>(name)) << name;
  }
}

}  // namespace
}  // namespace armloom
