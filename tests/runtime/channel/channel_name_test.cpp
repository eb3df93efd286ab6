#include "runtime/channel/channel_name.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "runtime/channel/channel_table.h"

namespace nacre {
namespace {

TEST(ChannelName, IsAGroupAndAComponent) {
  EXPECT_EQ(parse_channel("P.x"), (ChannelName{"P", 0}));
  EXPECT_EQ(parse_channel("color12.w"), (ChannelName{"color12", 3}));
  EXPECT_EQ(parse_channel("geomprop.my.age.y"), (ChannelName{"geomprop.my.age", 1}));
  EXPECT_EQ(parse_channel("state.120"), (ChannelName{"state", 120}));
  EXPECT_EQ(parse_channel("pdf"), (ChannelName{"pdf", -1}));
}

TEST(ChannelName, OfAnOutputWithDotsIsAsItIsWritten) {
  for (const char* name : {"", ".", ".x", "NG/out.q", "state.", "state.x1", "state.-1", "a.xy"}) {
    EXPECT_EQ(parse_channel(name), (ChannelName{name, -1})) << name;
  }
}

TEST(ChannelName, ReadsBackWhatItWrites) {
  for (const char* name : {"P.x", "geomprop.a.w", "state.0", "state.4294967", "lobe", "duv0dx.y"}) {
    const ChannelName parsed = parse_channel(name);
    EXPECT_EQ(channel_text(parsed.group, parsed.component), name);
  }
}

TEST(ChannelName, OfADerivativeNamesWhatItIsOf) {
  EXPECT_EQ(parse_derivative("dPdx"), (DerivativeName{"P", 0}));
  EXPECT_EQ(parse_derivative("duv3dy"), (DerivativeName{"uv3", 1}));
  EXPECT_EQ(derivative_text("uv3", 1), "duv3dy");
  for (const char* group : {"P", "dx", "ddx", "dPdu", "", "Pdx"}) {
    EXPECT_FALSE(parse_derivative(group)) << group;
  }
}

TEST(ChannelTable, FindsGroupsByNumberAndName) {
  const auto name_of = [](const char* group) {
    const ChannelGroup* found = find_channel_group(group);
    return found == nullptr ? std::string() : std::string(found->name);
  };
  EXPECT_EQ(name_of("P"), "P");
  EXPECT_EQ(name_of("uv0"), "uv*");
  EXPECT_EQ(name_of("duv17dy"), "duv*dy");
  EXPECT_EQ(name_of("geomprop.my.age"), "geomprop.*");
  for (const char* group : {"uv", "uvx", "uv0dx", "duvdx", "geomprop.", "Q", ""}) {
    EXPECT_EQ(find_channel_group(group), nullptr) << group;
  }
}

TEST(ChannelTable, HasEveryNameOnce) {
  std::set<std::string_view> names;
  for (const ChannelGroup& group : channel_groups()) {
    EXPECT_TRUE(names.insert(group.name).second) << group.name;
    EXPECT_FALSE(group.meaning.empty()) << group.name;
  }
}

}  // namespace
}  // namespace nacre
