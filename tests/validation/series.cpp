// SPDX-License-Identifier: MIT
#include "tests/validation/series.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace splash::validation {

namespace {

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream in(line);
  for (std::string word; std::getline(in, word, ',');) words.push_back(word);
  return words;
}

}  // namespace

Series::Series(std::vector<std::string> names)
    : names_(std::move(names)), columns_(names_.size()) {}

Series Series::read(const std::filesystem::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  Series series;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    const std::vector<std::string> words = split(line);
    if (series.names_.empty()) {
      series = Series(words);
      continue;
    }
    std::vector<double> row;
    for (const std::string& word : words) row.push_back(std::stod(word));
    if (row.size() != series.names_.size()) {
      throw std::runtime_error(path.string() + ":" + std::to_string(number) + ": " +
                               std::to_string(row.size()) + " numbers under " +
                               std::to_string(series.names_.size()) + " names");
    }
    series.add(row);
  }
  return series;
}

void Series::add(const std::vector<double>& row) {
  for (std::size_t i = 0; i < columns_.size(); ++i) columns_[i].push_back(row.at(i));
}

const Column& Series::operator[](const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) throw std::out_of_range("there is no column " + name);
  return columns_[static_cast<std::size_t>(found - names_.begin())];
}

std::size_t Series::size() const noexcept {
  return columns_.empty() ? 0 : columns_.front().size();
}

void Series::write(const std::filesystem::path& path) const {
  std::ofstream out(path);
  out.precision(9);
  for (std::size_t i = 0; i < names_.size(); ++i) out << (i == 0 ? "" : ",") << names_[i];
  out << '\n';
  for (std::size_t k = 0; k < size(); ++k) {
    for (std::size_t i = 0; i < columns_.size(); ++i) out << (i == 0 ? "" : ",") << columns_[i][k];
    out << '\n';
  }
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

double interpolate(const Column& x, const Column& y, double at) {
  const auto above = std::upper_bound(x.begin(), x.end(), at);
  if (above == x.begin()) return y.front();
  if (above == x.end()) return y.back();
  const auto k = static_cast<std::size_t>(above - x.begin());
  return y[k - 1] + (y[k] - y[k - 1]) * (at - x[k - 1]) / (x[k] - x[k - 1]);
}

double mean_between(const Column& x, const Column& y, double first, double last) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] < first || x[k] > last) continue;
    sum += y[k];
    ++count;
  }
  if (count == 0)
    throw std::runtime_error("no samples between " + std::to_string(first) + " and " +
                             std::to_string(last));
  return sum / count;
}

double largest_between(const Column& x, const Column& y, double first, double last) {
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] >= first && x[k] <= last) largest = std::max(largest, y[k]);
  }
  return largest;
}

double largest_rise(const Column& y) {
  double least = std::numeric_limits<double>::infinity();
  double rise = 0.0;
  for (const double value : y) {
    least = std::min(least, value);
    rise = std::max(rise, value - least);
  }
  return rise;
}

Column zero_crossings(const Column& x, const Column& y) {
  Column crossings;
  for (std::size_t k = 1; k < x.size(); ++k) {
    if ((y[k - 1] < 0.0) == (y[k] < 0.0)) continue;
    crossings.push_back(x[k - 1] - y[k - 1] * (x[k] - x[k - 1]) / (y[k] - y[k - 1]));
  }
  return crossings;
}

double first_reach(const Column& x, const Column& y, double level) {
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (y[k] < level) continue;
    if (k == 0) return x[0];
    return x[k - 1] + (x[k] - x[k - 1]) * (level - y[k - 1]) / (y[k] - y[k - 1]);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::pair<double, double> fit_line(const Column& x, const Column& y, double first, double last) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (x[k] < first || x[k] > last) continue;
    n += 1.0;
    sx += x[k];
    sy += y[k];
    sxx += x[k] * x[k];
    sxy += x[k] * y[k];
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {(sy - slope * sx) / n, slope};
}

double period_of(const Column& x, const Column& y) {
  const Column crossings = zero_crossings(x, y);
  if (crossings.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  return 2.0 * (crossings.back() - crossings[0]) / (static_cast<double>(crossings.size()) - 1.0);
}

Column linear(double a, const Column& x, double b) {
  Column values;
  for (const double value : x) values.push_back(a * value + b);
  return values;
}

Column combine(double a, const Column& x, double b, const Column& y) {
  Column sum(x.size());
  for (std::size_t k = 0; k < x.size(); ++k) sum[k] = a * x[k] + b * y.at(k);
  return sum;
}

}  // namespace splash::validation
