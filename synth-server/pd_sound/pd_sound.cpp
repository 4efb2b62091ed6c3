// SPDX-License-Identifier: MIT
#include "synth-server/pd_sound/pd_sound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "program/text.hpp"
#include "synth-server/output/rig_reader.hpp"
#include "synth-server/render/audibility.hpp"
#include "synth-server/sound/sound_rows.hpp"

namespace splash::synth {
namespace {

/// Rows that the patches do not play: linear theory, noise in place of bubbles, forces that the
/// simulator tells.
constexpr std::array kUnplayed = {"physical", "singles", "least"};

struct PdRow {
  std::string part;  ///< impact, bubble, cavity, cloud, fine, foot
  program::Row row;
  double number = 0.0;  ///< of the sound that was asked for
  [[nodiscard]] std::string name() const { return part + '_' + row.key; }
};

std::vector<PdRow> rows_of(const Sound& sound) {
  std::vector<PdRow> rows;
  each_part(sound, [&rows](const char* name, const auto& part) {
    for (const auto& field : fields_of(part, name)) {
      const std::string& key = field.row.key;
      if (std::find(kUnplayed.begin(), kUnplayed.end(), key) != kUnplayed.end()) continue;
      rows.push_back({name, field.row, number_of(part, field)});
    }
  });
  return rows;
}

/// Where surface and floor are, which the synth's command line says; far away at first.
std::vector<PdRow> with_levels(std::vector<PdRow> rows) {
  constexpr double kFar = 1e6;
  const auto level = [](const char* part) {
    return PdRow{part, {.key = "level", .unit = "m", .meaning = "", .min = -kFar, .max = kFar}};
  };
  rows.push_back(level("water"));
  rows.back().number = kFar;
  rows.push_back(level("floor"));
  rows.back().number = -kFar;
  return rows;
}

std::string number(double value) {
  return program::format("%.7g", value);
}

/// A patch that is being written: boxes get their numbers in the order in which they come.
class Patch {
 public:
  Patch(int width, int height)
      : text_("#N canvas 60 40 " + std::to_string(width) + ' ' + std::to_string(height) +
              " 12;\n") {}
  int add(const std::string& kind, int x, int y, const std::string& content) {
    text_ +=
        "#X " + kind + ' ' + std::to_string(x) + ' ' + std::to_string(y) + ' ' + content + ";\n";
    return boxes_++;
  }
  void connect(int from, int outlet, int to, int inlet) {
    cords_ += "#X connect " + std::to_string(from) + ' ' + std::to_string(outlet) + ' ' +
              std::to_string(to) + ' ' + std::to_string(inlet) + ";\n";
  }
  void licence(int x, int y) { add("text", x, y, "SPDX-License-Identifier: MIT"); }
  [[nodiscard]] std::string text() const { return text_ + cords_; }

 private:
  std::string text_;
  std::string cords_;
  int boxes_ = 0;
};

constexpr int kLine = 16;   // [pixels]
constexpr int kRow = 28;    // [pixels]
constexpr int kTop = 110;   // where rows begin
constexpr int kWide = 420;  // from column to column

/// Position of row `i`: impacts, bubbles and cavities have a column each, all others the last.
std::pair<int, int> place_of(const std::vector<PdRow>& rows, std::size_t i) {
  static const std::map<std::string, int> kColumns = {{"impact", 0}, {"bubble", 1}, {"cavity", 2}};
  const auto column_of = [](const PdRow& row) {
    const auto found = kColumns.find(row.part);
    return found == kColumns.end() ? static_cast<int>(kColumns.size()) : found->second;
  };
  const int column = column_of(rows[i]);
  const auto above = std::count_if(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(i),
                                   [&](const PdRow& row) { return column_of(row) == column; });
  return {20 + column * kWide, kTop + static_cast<int>(above) * kRow};
}

/// Every number as a [value] that the voices' [expr]s read, with its range.
std::string sound_patch(const std::vector<PdRow>& rows) {
  Patch patch(1720, 560);
  patch.add("text", 20, 8,
            "The sound's numbers \\, each a value that the voices read when they start: "
            "splash_impact_q and so on. Generated from synth-server's rows (pd-sound) \\, do not "
            "edit., f 110");
  patch.add("text", 20, 50,
            "splash-set-impact_q takes a number. Arguments of each: name \\, default (the paper's) "
            "\\, least \\, most., f 110");
  patch.licence(900, 50);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [x, y] = place_of(rows, i);
    patch.add("obj", x, y,
              "splash-row " + rows[i].name() + ' ' + number(rows[i].number) + ' ' +
                  number(rows[i].row.min) + ' ' + number(rows[i].row.max));
  }
  return patch.text();
}

/// One box for each number, and one message for each preset.
std::string controls_patch(const std::vector<PdRow>& rows, const std::vector<NamedSound>& presets) {
  Patch patch(1720, 620);
  patch.add(
      "text", 20, 8,
      "All numbers of the sound \\, live: type or drag. What starts from then on has them \\; "
      "configs/sounds/README.md says what each means. Generated (pd-sound) \\, do not edit., "
      "f 120");
  patch.licence(900, 8);
  patch.add("text", 20, 60, "presets:");
  int x = 110;
  const int send = patch.add("obj", 1000, 90, "s splash-preset");
  for (const NamedSound& preset : presets) {
    const int message = patch.add("msg", x, 60, "symbol " + preset.name);
    patch.connect(message, 0, send, 0);
    x += 8 * static_cast<int>(preset.name.size() + 10);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto [column, y] = place_of(rows, i);
    const program::Row& row = rows[i].row;
    const std::string unit = row.unit == "1" ? "" : " [" + row.unit + "]";
    patch.add("text", column, y, rows[i].part + ' ' + row.key + unit + ", f 30");
    patch.add("floatatom", column + 230, y,
              "10 " + number(row.min) + ' ' + number(row.max) + " 0 - splash-show-" +
                  rows[i].name() + " splash-set-" + rows[i].name() + " 0");
  }
  return patch.text();
}

/// splash-preset takes a sound's name.
std::string presets_patch(const std::vector<NamedSound>& presets) {
  std::string names;
  for (const NamedSound& preset : presets) names += ' ' + preset.name;
  const auto rows = rows_of(Sound{});
  const int height = 60 + static_cast<int>(rows.size()) * 16;
  Patch patch(900, 700);
  patch.add("text", 20, 8,
            "The shipped sounds: splash-preset takes a name. Generated from configs/sounds "
            "(pd-sound) \\, do not edit., f 100");
  patch.licence(600, 50);
  const int receive = patch.add("obj", 20, 50, "r splash-preset");
  const int route = patch.add("obj", 20, 80, "route" + names);
  patch.connect(receive, 0, route, 0);
  for (std::size_t k = 0; k < presets.size(); ++k) {
    std::string message;
    for (const PdRow& row : rows_of(presets[k].sound)) {
      message += " \\; splash-set-" + row.name() + ' ' + number(row.number);
    }
    const int box = patch.add("msg", 20, 120 + static_cast<int>(k) * height, message);
    patch.connect(route, static_cast<int>(k), box, 0);
  }
  return patch.text();
}

/// splash_impact_felt: what render/impact_level.cpp calls felt_level_db, of this output.
std::string felt_patch(const Output& output, const std::string& rig) {
  constexpr double kHandDecibels = -52.0;
  constexpr int kLowest = -17;
  constexpr int kThirds = 21;
  const bool is_felt = output.threshold.sense == Sense::touch;
  const double threshold_db = is_felt ? output.threshold.level_db : kHandDecibels;
  // F(f), the part of the resonator's noise under each edge, and a constant.
  std::string edges;
  for (int edge = 0; edge <= kThirds; ++edge) {
    const double f = 1000.0 * std::exp2((kLowest + edge - 0.5) / 3.0);
    const std::string u = '(' + number(f) + "/\\$f1-\\$f1/" + number(f) + ')';
    const std::string s = "\\$f2*sqrt(" + u + '*' + u + "+4)";
    edges += (edge == 0 ? "" : " \\; ") + ("(atan(\\$f2*" + u + ") + 0.5/\\$f3*log((" + s +
                                           " - \\$f3)/(" + s + " + \\$f3)))/3.14159265");
  }
  std::string loudest = "-1000";
  for (int third = 0; third < kThirds; ++third) {
    const double middle = 1000.0 * std::exp2((kLowest + third) / 3.0);
    const double level = -cut_db(output.band, middle) - touch_threshold_db(middle) - threshold_db;
    loudest = "max(" + loudest + " \\, 10*log10(\\$f" + std::to_string(third + 2) + " - \\$f" +
              std::to_string(third + 1) + ") + " + number(level) + ')';
  }
  Patch patch(900, 900);
  patch.add("text", 20, 8,
            "At which level over the threshold of touch an impact on the rig " + rig +
                " is felt whose amplitude drives it to full scale [dB]: its loudest third of an "
                "octave \\, over the first 125 ms. Generated (pd-sound) \\, do not edit., f 100");
  patch.licence(600, 70);
  int x = 20;
  // Shut until all numbers are there, which the loadbang of splash-sound.pd sees to.
  const int gate = patch.add("obj", 20, 200, "spigot");
  for (const char* key : {"frequency", "q", "attack", "release"}) {
    const int changed = patch.add("obj", x, 100, std::string("r splash-show-impact_") + key);
    patch.connect(changed, 0, gate, 0);
    x += 290;
  }
  const int start = patch.add("obj", 120, 140, "loadbang");
  const int open = patch.add("obj", 120, 170, "t b b");
  const int one = patch.add("msg", 190, 200, "1");
  patch.connect(start, 0, open, 0);
  patch.connect(open, 1, one, 0);
  patch.connect(one, 0, gate, 1);
  const int bang = patch.add("obj", 20, 230, "t b");
  patch.connect(gate, 0, bang, 0);
  patch.connect(open, 0, bang, 0);
  // Each box under the last one, however many lines that takes.
  int y = 260;
  int last = bang;
  const auto put = [&](const std::string& content, int cords) {
    const int box = patch.add("obj", 20, y, content);
    for (int k = cords - 1; k >= 0; --k) patch.connect(last, k, box, k);
    y += 30 + kLine * (static_cast<int>(content.size()) / 45 + 4);
    last = box;
  };
  put("expr splash_impact_frequency \\; splash_impact_q \\; "
      "sqrt(4*splash_impact_q*splash_impact_q - 1)",
      1);
  put("expr " + edges, 3);
  put("expr " + loudest, kThirds + 1);
  // The burst's mean square over the window.
  const std::string a = "(6.907755/splash_impact_attack)";
  const std::string r = "(13.81551/splash_impact_release)";
  put("expr \\$f1 + 10*log10(((splash_impact_attack - 1.998/" + a + " + 0.4999995/" + a +
          ")/0.998001 + (1 - exp(-" + r + "*(0.125 - splash_impact_attack)))/" + r + ")/0.125)",
      1);
  put("v splash_impact_felt", 1);
  return patch.text();
}

}  // namespace

std::map<std::string, std::string> pd_sound(const std::filesystem::path& configs) {
  std::vector<NamedSound> presets;
  for (const auto& entry : std::filesystem::directory_iterator(configs / "sounds")) {
    if (entry.path().extension() == ".yaml") presets.push_back(read_sound(entry.path()));
  }
  std::sort(presets.begin(), presets.end(),
            [](const NamedSound& a, const NamedSound& b) { return a.name < b.name; });
  const std::vector<PdRow> paper = with_levels(rows_of(Sound{}));
  const auto rig = [&](const char* name) {
    return read_rig(configs / "rigs" / name).outputs.at(0);
  };
  return {{"splash-sound.pd", sound_patch(paper)},
          {"splash-controls.pd", controls_patch(paper, presets)},
          {"splash-presets.pd", presets_patch(presets)},
          {"splash-felt-tiles.pd", felt_patch(rig("tiles36.yaml"), "tiles36")},
          {"splash-felt-stereo.pd", felt_patch(rig("stereo.yaml"), "stereo")}};
}

}  // namespace splash::synth
