// SPDX-License-Identifier: MIT
#include "sim-server/gauge/gauge_file.hpp"

#include <cerrno>

#include "program/failure.hpp"
#include "program/files.hpp"

namespace splash::sim {

namespace {

const Scene& with_probes(const Scene& scene) {
  if (!scene.gauges.probes.empty()) return scene;
  throw program::Failure(program::kExitConfig,
                         "the scene " + scene.name +
                             " names no gauges; add 'gauges:' with 'probes:' to it "
                             "(configs/README.md) or leave out --gauges");
}

program::WriteError cannot_write(const std::filesystem::path& path) {
  return {"cannot write gauges to " + path.string(), errno};
}

}  // namespace

GaugeFile::GaugeFile(const std::filesystem::path& path, const Scene& scene)
    : path_(path), gauges_(with_probes(scene)) {
  reopen();
}

void GaugeFile::reopen() {
  errno = 0;
  out_ = std::ofstream(path_);
  out_.precision(9);
  const char* separator = "";
  for (const std::string& column : gauges_.columns()) {
    out_ << separator << column;
    separator = ",";
  }
  out_ << std::endl;  // so that what follows is lines, whoever reads along
  if (!out_) throw cannot_write(path_);
}

void GaugeFile::note(double seconds, Fluid& fluid, const Bodies& bodies) {
  if (!gauges_.is_due(seconds)) return;
  errno = 0;
  const char* separator = "";
  for (const double value : gauges_.read(seconds, fluid, bodies)) {
    out_ << separator << value;
    separator = ",";
  }
  out_ << std::endl;
  if (!out_) throw cannot_write(path_);
}

}  // namespace splash::sim
