// SPDX-License-Identifier: MIT
#include "view-server/query.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "protocol/address.hpp"

namespace splash::view {
namespace {

using Json = nlohmann::ordered_json;
using protocol::AddressRow;
using protocol::ArgumentRow;

constexpr std::string_view kSim = "/sim";
constexpr std::string_view kSynth = "/synth";
constexpr int kRead = 1;
constexpr int kWrite = 2;

constexpr std::array<std::string_view, 8> kAttributes = {
    "FULL_PATH", "TYPE", "ACCESS", "RANGE", "VALUE", "DESCRIPTION", "UNIT", "CONTENTS"};
/// Commands that a page may say, by the program that takes them (admission.cpp).
constexpr std::array<std::string_view, 5> kToSim = {"/body/grab", "/body/pose", "/pause", "/reset",
                                                    "/scene"};
constexpr std::array<std::string_view, 4> kToSynth = {"/mute", "/tone", "/preset", "/rig"};

template <std::size_t N>
bool is_among(const std::array<std::string_view, N>& all, std::string_view one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

/// The node of an address, made with all above it where it is not there.
Json& node_of(Json& root, const std::string& address) {
  Json* node = &root;
  for (std::size_t begin = 1; begin < address.size();) {
    const std::size_t end = std::min(address.find('/', begin), address.size());
    Json& contents = (*node)["CONTENTS"];
    Json& child = contents[address.substr(begin, end - begin)];
    if (child.is_null()) child = {{"FULL_PATH", address.substr(0, end)}, {"ACCESS", 0}};
    node = &child;
    begin = end + 1;
  }
  return *node;
}

Json range_of(const ArgumentRow& row) {
  if (row.type != 'i' && row.type != 'f') return nullptr;
  return {{"MIN", row.min}, {"MAX", row.max}};
}

std::string words_of(const AddressRow& row) {
  std::string words(row.meaning);
  for (const ArgumentRow& argument : row.arguments) {
    words += "; " + std::string(argument.name) + ": " + std::string(argument.meaning);
  }
  return words;
}

void add(Json& root, std::string_view program, const AddressRow& row, int access) {
  Json& node = node_of(root, std::string(program) + std::string(row.address));
  node["TYPE"] = protocol::type_tags(row).substr(1);
  node["ACCESS"] = access;
  node["RANGE"] = Json::array();
  node["UNIT"] = Json::array();
  for (const ArgumentRow& argument : row.arguments) {
    node["RANGE"].push_back(range_of(argument));
    node["UNIT"].push_back(argument.unit);
  }
  node["DESCRIPTION"] = words_of(row);
}

void add_commands(Json& root) {
  for (const AddressRow& row : protocol::address_table()) {
    if (&row != protocol::find_address(row.address)) continue;  // one address has one type
    if (is_among(kToSim, row.address)) add(root, kSim, row, kWrite);
    if (is_among(kToSynth, row.address)) add(root, kSynth, row, kWrite);
    if (protocol::is_event(row.address)) add(root, kSim, row, kRead);
  }
}

void add_rows(Json& root, std::string_view program, const std::vector<Known::Row>& rows,
              const Known& known) {
  for (const Known::Row& row : rows) {
    Json& node = node_of(root, std::string(program) + '/' + row.name);
    const auto value = known.values.find(row.name);
    node["TYPE"] = "f";
    node["ACCESS"] = kRead | kWrite;
    node["RANGE"] = {{{"MIN", row.min}, {"MAX", row.max}}};
    node["VALUE"] = Json::array();
    if (value != known.values.end()) node["VALUE"].push_back(value->second);
    node["DESCRIPTION"] = row.meaning;
    node["UNIT"] = {row.unit};
  }
}

Json value_of(const protocol::Argument& argument) {
  if (const auto* whole = std::get_if<std::int32_t>(&argument)) return *whole;
  if (const auto* number = std::get_if<float>(&argument)) return *number;
  if (const auto* text = std::get_if<std::string>(&argument)) return *text;
  return nullptr;
}

/// Each field of a program's status is an address of its own.
void add_status(Json& root, std::string_view program, std::string_view name,
                const std::optional<protocol::Message>& told) {
  for (const AddressRow& row : protocol::address_table()) {
    if (row.address != "/status.reply" || row.arguments.front().fixed != name) continue;
    for (std::size_t i = 1; i < row.arguments.size(); ++i) {
      const ArgumentRow& field = row.arguments[i];
      Json& node = node_of(root, std::string(program) + "/status/" + std::string(field.name));
      node["TYPE"] = std::string(1, field.type);
      node["ACCESS"] = kRead;
      node["RANGE"] = {range_of(field)};
      node["VALUE"] = Json::array();
      if (told && i < told->arguments.size()) node["VALUE"].push_back(value_of(told->arguments[i]));
      node["DESCRIPTION"] = field.meaning;
      node["UNIT"] = {field.unit};
    }
  }
}

Json tree(const Known& known) {
  Json root = {{"FULL_PATH", "/"}, {"ACCESS", 0}, {"DESCRIPTION", "splash: feel water"}};
  add_commands(root);
  add_status(root, kSim, "sim-server", known.sim);
  add_status(root, kSynth, "synth-server", known.synth);
  add_rows(root, kSim, known.scene_rows, known);
  add_rows(root, kSynth, known.rows, known);
  return root;
}

Json host_info(int port) {
  Json info = {{"NAME", "splash"},
               {"EXTENSIONS",
                {{"ACCESS", true},
                 {"VALUE", true},
                 {"RANGE", true},
                 {"DESCRIPTION", true},
                 {"UNIT", true},
                 {"LISTEN", true},
                 {"PATH_CHANGED", false}}}};
  if (port != 0) {
    info["OSC_PORT"] = port;
    info["OSC_TRANSPORT"] = "UDP";
  }
  return info;
}

Answer answer(const Json& json) {
  return {200, json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

const Json* find(const Json& root, std::string_view path) {
  const Json* node = &root;
  for (std::size_t begin = 1; begin < path.size();) {
    const std::size_t end = std::min(path.find('/', begin), path.size());
    const auto contents = node->find("CONTENTS");
    if (contents == node->end()) return nullptr;
    const auto child = contents->find(std::string(path.substr(begin, end - begin)));
    if (child == contents->end()) return nullptr;
    node = &*child;
    begin = end + 1;
  }
  return node;
}

std::optional<std::string> behind(std::string_view prefix, const std::string& address) {
  const bool has = address.size() > prefix.size() && address.starts_with(prefix) &&
                   address[prefix.size()] == '/';
  return has ? std::optional(address.substr(prefix.size())) : std::nullopt;
}

/// Of a frame, those of one program, whose values are told anew.
std::vector<Known::Row> read_rows(const Json& frame, std::map<std::string, double>& values) {
  std::vector<Known::Row> rows;
  if (!frame.is_object() || !frame.contains("rows") || !frame["rows"].is_array()) return rows;
  for (const Json& row : frame["rows"]) {
    try {
      const auto name = row.at("name").get<std::string>();
      rows.push_back({name, row.at("min").get<double>(), row.at("max").get<double>(),
                      row.at("unit").get<std::string>(), row.at("meaning").get<std::string>()});
      values[name] = row.at("value").get<double>();
    } catch (const Json::exception&) {  // a row of another kind says nothing here
    }
  }
  return rows;
}

/// The names of the bodies in a scene's frame, in its order; "" for a body without a name.
std::vector<std::string> read_bodies(const Json& frame) {
  std::vector<std::string> names;
  if (!frame.is_object() || !frame.contains("bodies")) return names;
  for (const Json& body : frame["bodies"]) {
    const bool named = body.is_object() && body.contains("name") && body["name"].is_string();
    names.push_back(named ? body["name"].get<std::string>() : std::string());
  }
  return names;
}

}  // namespace

bool is_of_scene(std::string_view row) {
  return row.starts_with("detect/");
}

void note_rig(std::string_view text, Known& known) {
  std::erase_if(known.values, [](const auto& value) { return !is_of_scene(value.first); });
  known.rows = read_rows(Json::parse(text, nullptr, false), known.values);
}

void note_scene(std::string_view text, Known& known) {
  std::erase_if(known.values, [](const auto& value) { return is_of_scene(value.first); });
  const Json frame = Json::parse(text, nullptr, false);
  known.scene_rows = read_rows(frame, known.values);
  known.bodies = read_bodies(frame);
}

Answer query(const Known& known, std::string_view path, std::string_view attribute, int port) {
  if (attribute == "HOST_INFO") return answer(host_info(port));
  const Json root = tree(known);
  const Json* node = find(root, path);
  if (node == nullptr) return {404, {}};
  if (attribute.empty()) return answer(*node);
  if (!is_among(kAttributes, attribute)) return {400, {}};
  const auto value = node->find(std::string(attribute));
  if (value == node->end()) return {204, {}};
  return answer({{std::string(attribute), *value}});
}

std::optional<protocol::Message> meant(const protocol::Message& message) {
  const auto of_sim = behind(kSim, message.address);
  const auto own = of_sim ? of_sim : behind(kSynth, message.address);
  if (!own) return std::nullopt;
  if (of_sim ? is_among(kToSim, *own) : is_among(kToSynth, *own)) {
    return protocol::Message{*own, message.arguments};
  }
  const std::string name = own->substr(1);
  if (is_of_scene(name) != of_sim.has_value() || message.arguments.size() != 1) return std::nullopt;
  const auto* whole = std::get_if<std::int32_t>(&message.arguments.front());
  const auto* number = std::get_if<float>(&message.arguments.front());
  if (whole == nullptr && number == nullptr) return std::nullopt;
  const float value = number != nullptr ? *number : static_cast<float>(*whole);
  return protocol::Message{of_sim ? "/param" : "/set", {name, value}};
}

std::string told_as(const protocol::Message& message) {
  if (protocol::is_event(message.address)) return std::string(kSim) + message.address;
  if (message.address != "/value" || message.arguments.empty()) return {};
  const auto* name = std::get_if<std::string>(&message.arguments.front());
  if (name == nullptr) return {};
  return std::string(is_of_scene(*name) ? kSim : kSynth) + '/' + *name;
}

}  // namespace splash::view
