// SPDX-License-Identifier: MIT
#include "tests/bench/report.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <thread>

#include "tests/support/source_folder.hpp"
#include "tests/support/text_of.hpp"

namespace splash::bench {
namespace {

std::string first_line(const std::string& command) {
  std::array<char, 256> line{};
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  if (!pipe || std::fgets(line.data(), line.size(), pipe.get()) == nullptr) return {};
  std::string text = line.data();
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

/// With "-dirty" where anything differs from it but docs/, which the benchmarks themselves write.
std::string commit() {
  const std::string git = "git -C '" + tests::source_folder().string() + "' ";
  const std::string told = first_line(git + "describe --always 2>&1");
  if (told.empty() || told.starts_with("fatal")) return "of no known commit";
  return "commit " + told + first_line(git + "diff --quiet HEAD -- . ':!docs' || echo -dirty");
}

std::string today() {
  const std::time_t now = std::time(nullptr);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d", std::gmtime(&now));
  return text.data();
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

/// Programs that ran or waited, on average over the last minute.
std::string load() {
  double mean = 0.0;
  std::ifstream("/proc/loadavg") >> mean;
  return number(mean, 2);
}

/// The text of a file in docs/ with this bench's section replaced, or added at the end.
std::string with_section(const std::string& text, const std::string& bench,
                         const std::string& section) {
  const std::string begin = "<!-- bench " + bench + " -->\n";
  const std::string end = "<!-- end of bench " + bench + " -->\n";
  const std::string whole = begin + section + end;
  const std::size_t from = text.find(begin);
  const std::size_t to = text.find(end);
  if (from == std::string::npos || to == std::string::npos || to < from) return text + '\n' + whole;
  return text.substr(0, from) + whole + text.substr(to + end.size());
}

}  // namespace

bool is_wanted(const std::vector<std::string>& asked, const std::string& name) {
  return asked.empty() || std::find(asked.begin(), asked.end(), name) != asked.end();
}

Bench::Bench(std::string name, std::string doc, std::string title, const std::string& what)
    : name_(std::move(name)),
      doc_(std::move(doc)),
      title_(std::move(title)),
      out_(tests::source_folder() / "out" / name_),
      app_(what, "bench-" + name_) {
  app_.add_option("--out", out_, "Folder for tables and pictures")->capture_default_str();
  if (doc_.empty()) return;
  app_.add_flag("--write-docs", to_docs_, "Writes its section of docs/" + doc_ + ", too");
}

void Bench::add_device_option(int& device) {
  app_.add_option("--device", device, "OpenCL device as sim-server --list-devices counts");
}

int Bench::run(int argc, char** argv, const std::function<bool()>& measure) {
  CLI11_PARSE(app_, argc, argv);
  command_ = "./splash bench " + name_;
  for (int k = 1; k < argc; ++k) command_ += std::string(k == 1 ? " -- " : " ") + argv[k];
  try {
    std::filesystem::create_directories(out_);
    const std::string begun = load();
    const bool right = measure();
    if (to_docs_) write_docs(begun);
    return right ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "bench-" << name_ << ": " << error.what() << '\n';
    return 70;
  }
}

void Bench::set_device(const std::string& description) {
  device_ = description;
  std::printf("device: %s\n", device_.c_str());
}

Table Bench::table(const std::string& file, Row head) const {
  return Table(std::move(head), out_ / file);
}

void Bench::say(const std::string& paragraph) {
  std::printf("\n%s\n", paragraph.c_str());
  tell(paragraph);
}

void Bench::show(const std::string& picture, const std::string& what) {
  pictures_.push_back(picture);
  tell("![" + what + "](" + picture + ")");
}

void Bench::write_docs(const std::string& begun) const {
  const std::filesystem::path docs = tests::source_folder() / "docs";
  const std::filesystem::path path = docs / doc_;
  std::string section = "## " + title_ + "\n\n`" + command_ + "`, " + today() + ", " + commit() +
                        ", " + processor() + " (" +
                        std::to_string(std::thread::hardware_concurrency()) + " cores)";
  if (!device_.empty()) section += ", " + device_;
  section += "; load " + begun + " before, " + load() + " after.\n\n" + section_.str();
  const std::string updated = with_section(tests::text_of(path), name_, section);
  std::ofstream file(path);
  file << updated;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
  for (const std::string& picture : pictures_) {
    std::filesystem::copy_file(out_ / picture, docs / picture,
                               std::filesystem::copy_options::overwrite_existing);
  }
  std::printf("written: %s\n", path.c_str());
}

}  // namespace splash::bench
