// SPDX-License-Identifier: Apache-2.0
#include "scene_json.hpp"

#include "json_scanner.hpp"

#include <google/protobuf/descriptor.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace stoss::idl {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::EnumValueDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;

// The structural half: values into the fields of a message.
class Reader {
 public:
  Reader(std::string_view text, const std::string* wanted) : scanner_(text), wanted_(wanted) {}

  void read(Message& message) {
    object(message);
    scanner_.expect_end();
  }

  [[nodiscard]] std::string path() const {
    std::string out;
    for (const Step& step : path_) {
      if (!out.empty()) out += '.';
      out += step.name;
      if (step.index >= 0) out += '[' + std::to_string(step.index) + ']';
    }
    return out;
  }
  [[nodiscard]] std::size_t located() const noexcept { return located_; }

 private:
  struct Step {
    std::string_view name;
    int index;
  };

  // When a place is wanted, every value on the way to it leaves its own: the last is the innermost.
  void visit() {
    if (wanted_ == nullptr) return;
    const std::string here = path();
    const bool on_the_way =
        wanted_->compare(0, here.size(), here) == 0 &&
        (here.empty() || here.size() == wanted_->size() || (*wanted_)[here.size()] == '.');
    if (!on_the_way) return;
    scanner_.peek();
    located_ = scanner_.offset();
  }

  void object(Message& message) {
    visit();
    scanner_.expect('{', "to open an object");
    if (scanner_.accept('}')) return;
    std::uint64_t seen = 0;  // field numbers; the formats here have none above 63
    do {
      member(message, seen);
    } while (scanner_.accept(','));
    scanner_.expect('}', "or ',' after a member");
  }

  void member(Message& message, std::uint64_t& seen) {
    if (scanner_.peek() != '"') {
      scanner_.fail("expected a field's name in quotes, but found " + scanner_.found());
    }
    const std::size_t begin = scanner_.offset();
    const std::string name = scanner_.string();
    const FieldDescriptor* field = message.GetDescriptor()->FindFieldByName(name);
    // The mapping lets every reader take the camel-case names too.
    if (field == nullptr) field = message.GetDescriptor()->FindFieldByCamelcaseName(name);
    if (field == nullptr)
      JsonScanner::fail_at(begin, unknown_field(name, *message.GetDescriptor()));
    const std::uint64_t bit = std::uint64_t{1} << static_cast<unsigned>(field->number());
    path_.push_back({field->name(), -1});
    if ((seen & bit) != 0) JsonScanner::fail_at(begin, "the field is given twice");
    seen |= bit;
    scanner_.expect(':', "after a field's name");
    if (!scanner_.accept_word("null")) {
      if (field->is_repeated()) {
        list(message, *field);
      } else {
        value(message, *field);
      }
    }
    path_.pop_back();
  }

  static std::string unknown_field(const std::string& name, const Descriptor& type) {
    std::string out = quoted(name) + " is not a field of " + type.name() + "; its fields are";
    for (int i = 0; i < type.field_count(); ++i) {
      out += (i == 0 ? " " : ", ") + type.field(i)->name();
    }
    return out;
  }

  void list(Message& message, const FieldDescriptor& field) {
    scanner_.expect('[', "to open a list");
    if (scanner_.accept(']')) return;
    path_.back().index = 0;
    do {
      value(message, field);
      ++path_.back().index;
    } while (scanner_.accept(','));
    path_.back().index = -1;
    scanner_.expect(']', "or ',' after an element");
  }

  // Numbers may also stand in quotes.
  std::string number_text(const char* kind) {
    const char c = scanner_.peek();
    if (c == '"') return scanner_.string();
    if (c == '-' || (c >= '0' && c <= '9')) return std::string(scanner_.number());
    scanner_.fail(std::string("expected ") + kind + ", but found " + scanner_.found());
  }

  template <class Parse>
  auto number(Parse parse, const char* kind) {
    scanner_.peek();
    const std::size_t begin = scanner_.offset();
    const std::string text = number_text(kind);
    const auto value = parse(text);
    if (!value) JsonScanner::fail_at(begin, quoted(text) + " is not " + kind);
    return *value;
  }

  bool boolean() {
    if (scanner_.accept_word("true")) return true;
    if (scanner_.accept_word("false")) return false;
    scanner_.fail("expected true or false, but found " + scanner_.found());
  }

  int enumeration(const FieldDescriptor& field) {
    scanner_.peek();
    const std::size_t begin = scanner_.offset();
    const std::string text = number_text("a word in quotes");
    const google::protobuf::EnumDescriptor& type = *field.enum_type();
    const EnumValueDescriptor* named = type.FindValueByName(text);
    if (named == nullptr) {
      const std::optional<std::int32_t> number = to_integer<std::int32_t>(text);
      if (number) named = type.FindValueByNumber(*number);
    }
    if (named != nullptr) return named->number();
    std::string reason = quoted(text) + " is none of";
    for (int i = 0; i < type.value_count(); ++i) {
      reason += (i == 0 ? " " : ", ") + type.value(i)->name();
    }
    JsonScanner::fail_at(begin, reason);
  }

  void value(Message& message, const FieldDescriptor& field);

  JsonScanner scanner_;
  const std::string* wanted_;
  std::vector<Step> path_;
  std::size_t located_ = 0;
};

void Reader::value(Message& message, const FieldDescriptor& field) {
  const Reflection& reflection = *message.GetReflection();
  const bool many = field.is_repeated();
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
    object(many ? *reflection.AddMessage(&message, &field)
                : *reflection.MutableMessage(&message, &field));
    return;
  }
  visit();
  if (many) scanner_.fail("lists of this type are not supported");
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.SetDouble(
          &message, &field, number(to_double, "a number in the range of doubles"));
    case FieldDescriptor::CPPTYPE_UINT64:
      return reflection.SetUInt64(
          &message, &field, number(to_integer<std::uint64_t>, "an integer from 0 to 2^64 - 1"));
    case FieldDescriptor::CPPTYPE_INT64:
      return reflection.SetInt64(
          &message, &field, number(to_integer<std::int64_t>, "an integer of 64 bits"));
    case FieldDescriptor::CPPTYPE_BOOL:
      return reflection.SetBool(&message, &field, boolean());
    case FieldDescriptor::CPPTYPE_ENUM:
      return reflection.SetEnumValue(&message, &field, enumeration(field));
    case FieldDescriptor::CPPTYPE_STRING:
      if (scanner_.peek() != '"') {
        scanner_.fail("expected a string, but found " + scanner_.found());
      }
      return reflection.SetString(&message, &field, scanner_.string());
    case FieldDescriptor::CPPTYPE_INT32:
    case FieldDescriptor::CPPTYPE_UINT32:
    case FieldDescriptor::CPPTYPE_FLOAT:
    case FieldDescriptor::CPPTYPE_MESSAGE:
      break;
  }
  scanner_.fail("fields of this type are not supported");
}

}  // namespace

std::optional<JsonError> read_json(std::string_view text, Message& message) {
  Reader reader(text, nullptr);
  try {
    reader.read(message);
  } catch (const JsonFailure& failure) {
    return JsonError{{failure.offset, reader.path()}, failure.reason};
  }
  return std::nullopt;
}

std::size_t locate_json(std::string_view text, const Message& prototype, const std::string& field) {
  const std::unique_ptr<Message> scratch(prototype.New());
  Reader reader(text, &field);
  try {
    reader.read(*scratch);
  } catch (const JsonFailure&) {
    // What was found before the failure is the best there is.
    return reader.located();
  }
  return reader.located();
}

}  // namespace stoss::idl
