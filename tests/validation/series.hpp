// SPDX-License-Identifier: MIT
// Columns of numbers: what gauges gave, or what others measured.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace splash::validation {

using Column = std::vector<double>;

/// Columns of equal length, by name; the first is what the others depend on.
class Series {
 public:
  Series() = default;
  explicit Series(std::vector<std::string> names);
  /// A CSV file: lines that begin with # are remarks, then a header, then numbers. Throws
  /// std::runtime_error that names file and line.
  [[nodiscard]] static Series read(const std::filesystem::path& path);

  void add(const std::vector<double>& row);
  [[nodiscard]] const std::vector<std::string>& names() const noexcept { return names_; }
  /// Throws std::out_of_range that names the column.
  [[nodiscard]] const Column& operator[](const std::string& name) const;
  [[nodiscard]] std::size_t size() const noexcept;
  void write(const std::filesystem::path& path) const;

 private:
  std::vector<std::string> names_;
  std::vector<Column> columns_;
};

/// Straight lines between points; the first and last value outside. `x` rises.
[[nodiscard]] double interpolate(const Column& x, const Column& y, double at);
/// Mean of y where first <= x <= last; throws std::runtime_error where there is no sample.
[[nodiscard]] double mean_between(const Column& x, const Column& y, double first, double last);
[[nodiscard]] double largest_between(const Column& x, const Column& y, double first, double last);
/// The most that a later value lies above an earlier one; 0 where none does.
[[nodiscard]] double largest_rise(const Column& y);
/// Where y changes sign, by straight lines.
[[nodiscard]] Column zero_crossings(const Column& x, const Column& y);
/// First x at which y reaches `level`, by straight lines; not a number when it never does.
[[nodiscard]] double first_reach(const Column& x, const Column& y, double level);
/// Least squares y = offset + slope x over first <= x <= last: {offset, slope}.
[[nodiscard]] std::pair<double, double> fit_line(const Column& x, const Column& y, double first,
                                                 double last);
/// Twice the mean distance of the zero crossings of what swings about zero; not a number with fewer
/// than three.
[[nodiscard]] double period_of(const Column& x, const Column& y);
/// a x + b and a x + b y, element by element.
[[nodiscard]] Column linear(double a, const Column& x, double b = 0.0);
[[nodiscard]] Column combine(double a, const Column& x, double b, const Column& y);

}  // namespace splash::validation
