// What cannot be meant, and what an older or newer host gives.
#include <gtest/gtest.h>
#include <nacre/nacre.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace {

TEST(ApiArguments, NothingIsNoObject) {
  nacre_report* report = nullptr;
  ASSERT_EQ(nacre_report_create(&report), NACRE_OK);
  nacre_shader* shader = reinterpret_cast<nacre_shader*>(1);
  EXPECT_EQ(nacre_compile_material(nullptr, nullptr, "M", nullptr, report, &shader),
            NACRE_WRONG_ARGUMENTS);
  EXPECT_EQ(shader, nullptr);
  nacre_document* document = nullptr;
  EXPECT_EQ(nacre_document_read(nullptr, nullptr, report, &document), NACRE_WRONG_ARGUMENTS);
  EXPECT_EQ(nacre_document_read("a.mtlx", nullptr, report, nullptr), NACRE_WRONG_ARGUMENTS);
  nacre_instance* instance = nullptr;
  EXPECT_EQ(nacre_instance_create(nullptr, &instance), NACRE_WRONG_ARGUMENTS);
  nacre_binding* binding = nullptr;
  EXPECT_EQ(nacre_binding_create(nullptr, nullptr, 0, report, &binding), NACRE_WRONG_ARGUMENTS);
  EXPECT_EQ(nacre_run(nullptr, NACRE_BEGIN, nullptr, nullptr), NACRE_WRONG_ARGUMENTS);
  EXPECT_EQ(nacre_shader_has(nullptr, NACRE_BEGIN), 0);
  EXPECT_EQ(nacre_shader_find_parameter(nullptr, "x"), SIZE_MAX);
  EXPECT_EQ(nacre_document_material(nullptr, 0), nullptr);
  EXPECT_EQ(nacre_report_count(report), 0u);
  for (const auto destroy : {nacre_report_destroy}) destroy(nullptr);
  nacre_system_destroy(nullptr);
  nacre_document_destroy(nullptr);
  nacre_shader_destroy(nullptr);
  nacre_instance_destroy(nullptr);
  nacre_binder_destroy(nullptr);
  nacre_binding_destroy(nullptr);
  nacre_report_destroy(report);
}

TEST(ApiArguments, NothingIsNoNode) {
  nacre_value value{};
  EXPECT_EQ(nacre_node_recorder(nullptr), nullptr);
  EXPECT_STREQ(nacre_node_nodedef(nullptr), "");
  EXPECT_STREQ(nacre_node_input_type(nullptr, "in"), "");
  EXPECT_EQ(nacre_node_input(nullptr, "in", &value, 1), 0u);
  EXPECT_STREQ(nacre_node_text(nullptr, "in"), "");
  EXPECT_STREQ(nacre_node_output_type(nullptr, nullptr), "");
  nacre_node_set(nullptr, nullptr, &value, 1);
  nacre_node_error(nullptr, "no");
  nacre_node_set_lobe(nullptr, nullptr);
  EXPECT_EQ(nacre_node_accuracy(nullptr), NACRE_STANDARD);
}

TEST(ApiArguments, StructuresAreAsLongAsTheHostsVersionOfThem) {
  nacre_report* report = nullptr;
  ASSERT_EQ(nacre_report_create(&report), NACRE_OK);
  nacre_document* document = nullptr;
  // An older host's options end before the last member: what lies behind is not read.
  struct Old {
    size_t size;
    const char* const* search_paths;
    size_t search_path_count;
    char garbage[16];
  } old{offsetof(nacre_read_options, includes_anywhere), nullptr, 0, {}};
  std::memset(old.garbage, 0x7f, sizeof old.garbage);
  EXPECT_EQ(
      nacre_document_read("/nowhere/missing.mtlx",
                          reinterpret_cast<const nacre_read_options*>(&old), report, &document),
      NACRE_FAILED);
  ASSERT_EQ(nacre_report_count(report), 1u);
  // And what is handed to it ends where its structure does.
  nacre_diagnostic short_one;
  std::memset(&short_one, 0x7f, sizeof short_one);
  short_one.size = offsetof(nacre_diagnostic, message);
  ASSERT_EQ(nacre_report_get(report, 0, &short_one), NACRE_OK);
  EXPECT_EQ(short_one.severity, NACRE_ERROR);
  EXPECT_EQ(std::string(short_one.file), "/nowhere/missing.mtlx");
  std::uintptr_t untouched = 0;
  std::memcpy(&untouched, &short_one.message, sizeof untouched);
  EXPECT_EQ(untouched, 0x7f7f7f7f7f7f7f7fu);
  short_one.size = 0;
  EXPECT_EQ(nacre_report_get(report, 0, &short_one), NACRE_WRONG_ARGUMENTS);
  EXPECT_EQ(nacre_report_get(report, 1, &short_one), NACRE_WRONG_ARGUMENTS);
  nacre_report_clear(report);
  EXPECT_EQ(nacre_report_count(report), 0u);
  nacre_report_destroy(report);
}

TEST(ApiArguments, StructuresWithoutASizeAreRefused) {
  nacre_system* system = nullptr;
  const nacre_system_options no_options{};
  EXPECT_EQ(nacre_system_create(&no_options, nullptr, &system), NACRE_WRONG_ARGUMENTS);
  const nacre_body no_body{};
  nacre_system_options options{};
  options.size = sizeof options;
  options.bodies = &no_body;
  options.body_count = 2;
  EXPECT_EQ(nacre_system_create(&options, nullptr, &system), NACRE_WRONG_ARGUMENTS);
  nacre_document* document = nullptr;
  const nacre_read_options no_reading{};
  EXPECT_EQ(nacre_document_parse("", 0, "", &no_reading, nullptr, &document),
            NACRE_WRONG_ARGUMENTS);
  nacre_binder* binder = nullptr;
  ASSERT_EQ(nacre_binder_create(&binder), NACRE_OK);
  const nacre_layout no_layout{};
  EXPECT_EQ(nacre_binder_array(binder, "P", &no_layout), NACRE_WRONG_ARGUMENTS);
  nacre_binder_destroy(binder);
}

TEST(ApiArguments, TheVersionIsThatOfTheHeaders) {
  EXPECT_EQ(nacre_version(), NACRE_VERSION);
  EXPECT_EQ(nacre_version_text(), std::to_string(NACRE_VERSION_MAJOR) + "." +
                                      std::to_string(NACRE_VERSION_MINOR) + "." +
                                      std::to_string(NACRE_VERSION_PATCH));
}

TEST(ApiArguments, EveryGroupOfChannelsIsDescribed) {
  ASSERT_GT(nacre_channel_group_count(), 30u);
  for (size_t i = 0; i < nacre_channel_group_count(); ++i) {
    nacre_channel_group group{};
    group.size = sizeof group;
    ASSERT_EQ(nacre_channel_group_get(i, &group), NACRE_OK);
    EXPECT_NE(std::string(group.name), "");
    EXPECT_NE(std::string(group.meaning), "");
    EXPECT_GT(group.components, 0);
  }
}

}  // namespace
