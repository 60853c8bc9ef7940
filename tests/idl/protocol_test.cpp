// SPDX-License-Identifier: Apache-2.0
// PROTOCOL.md keeps what it says: its bytes decode to its values, and no constant is missing from
// it.
#include <stoss/dds/dds.hpp>
#include <stoss/idl/topics.hpp>

#include <dds/ddsi/ddsi_serdata.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace stoss::tests {
namespace {

constexpr std::uint32_t kDomain = 53;

std::string content_of(const char* path) {
  std::ifstream in(path);
  EXPECT_TRUE(in) << path;
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

std::string page() { return content_of(STOSS_IDL_DIR "/PROTOCOL.md"); }

// The bytes of the page's ```hex block.
std::string bytes_of_the_page() {
  const std::string text = page();
  constexpr std::string_view kOpening = "```hex\n";
  const std::size_t begin = text.find(kOpening) + kOpening.size();
  std::istringstream block(text.substr(begin, text.find("```", begin) - begin));
  std::string bytes;
  std::string line;
  while (std::getline(block, line)) {
    std::istringstream pairs(line.substr(0, line.find("//")));
    for (std::string pair; pairs >> pair;) bytes += pair;
  }
  return bytes;
}

TEST(Protocol, BytesOfTheExampleAreThoseOnTheWire) {
  dds::Network network;
  network.role = dds::Role::kDaemon;
  const dds::Participant participant(kDomain, network);
  const dds::Publisher publisher(participant, "page");
  const dds::Subscriber subscriber(participant, "page");
  const auto topic = idl::make_topic(participant, idl::kBodyTopic);
  const auto reader = idl::make_reader(subscriber, topic, idl::kBodyTopic);
  auto writer = idl::make_writer(publisher, topic, idl::kBodyTopic);
  idl::wire::BodyState body{};
  body.slot = 3;
  body.epoch = 1;
  body.id = 7;
  body.kind = idl::wire_value(idl::BodyKind::kDynamic);
  body.at = {2, UINT64_C(1) << 63U};
  body.x = 1.5;
  body.y = -0.25;
  body.vx = 0.1;
  body.radius = 0.5;
  ASSERT_TRUE(writer.write(body));

  ddsi_serdata* serdata = nullptr;
  dds_sample_info_t info;
  ASSERT_EQ(dds_takecdr(reader.handle(), &serdata, 1, &info, DDS_ANY_STATE), 1);
  std::vector<unsigned char> bytes(ddsi_serdata_size(serdata));
  ddsi_serdata_to_ser(serdata, 0, bytes.size(), bytes.data());
  ddsi_serdata_unref(serdata);
  std::string hex;
  for (const unsigned char byte : bytes) {
    std::array<char, 3> pair{};
    std::snprintf(pair.data(), pair.size(), "%02x", byte);
    hex += pair.data();
  }
  EXPECT_EQ(bytes_of_the_page(), hex);
}

TEST(Protocol, EveryTopicOperationAndCodeIsExplained) {
  const std::string text = page();
  const std::string types = content_of(STOSS_IDL_DIR "/stoss.idl");
  const std::regex constant("const (unsigned short|octet) (OP|ASK|CODE)_([A-Z_]+) =");
  int count = 0;
  for (auto it = std::sregex_iterator(types.begin(), types.end(), constant);
       it != std::sregex_iterator();
       ++it, ++count) {
    EXPECT_NE(text.find('`' + (*it)[3].str() + '`'), std::string::npos) << (*it)[3].str();
  }
  EXPECT_GT(count, 30);
  for (const char* const topic : {"command",
                                  "reply",
                                  "query",
                                  "answer",
                                  "motion",
                                  "frame",
                                  "body",
                                  "collision",
                                  "zone",
                                  "scene",
                                  "status"}) {
    EXPECT_NE(text.find('`' + std::string(topic) + '`'), std::string::npos) << topic;
  }
}

// The bounds in the page are those of the types.
TEST(Protocol, BoundsAreThoseOfTheTypes) {
  const std::string text = page();
  const std::string types = content_of(STOSS_IDL_DIR "/stoss.idl");
  const std::regex bound("const unsigned long (MAX_[A-Z_]+) = ([0-9]+);");
  for (auto it = std::sregex_iterator(types.begin(), types.end(), bound);
       it != std::sregex_iterator();
       ++it) {
    const std::string row = "| `" + (*it)[1].str() + "` | " + (*it)[2].str() + " |";
    EXPECT_NE(text.find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace stoss::tests
