// SPDX-License-Identifier: MIT
// pd-sound: writes the generated patches anew. ninja pd-sound && bin/pd-sound configs pd-patches
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "synth-server/pd_sound/pd_sound.hpp"

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: pd-sound CONFIGS FOLDER: writes the generated patches into FOLDER\n";
    return 64;
  }
  try {
    for (const auto& [name, text] : splash::synth::pd_sound(argv[1])) {
      std::ofstream(std::filesystem::path(argv[2]) / name) << text;
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "pd-sound: " << error.what() << '\n';
    return 78;
  }
}
