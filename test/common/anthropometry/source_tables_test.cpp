// Holds config/kinematics/measures.yaml against itself and against the sums of the source's
// columns: no row is missing, and no digit differs.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/anthropometry/body_measures.h"

namespace deixis::anthropometry {
namespace {

using Table = std::vector<BodyMeasure>;

constexpr Sex kSexes[] = {Sex::kFemale, Sex::kMale};
const std::array<std::string, 7> kColumns{"p1", "p5", "p50", "p95", "p99", "percent", "half_range"};

/// With the README of config/kinematics, the full list: another one is a slip of ours.
const std::set<std::string> kWrongSums{"female koh", "male koh",   "male ala", "female oslp",
                                       "male oslp",  "female usl", "male usl"};

const BodyMeasures& Shipped() {
  static const BodyMeasures measures =
      BodyMeasures::Load({DEIXIS_SOURCE_DIR "/config/kinematics/measures.yaml"});
  return measures;
}

/// A column of a measure, as it stands in the file or as the source prints it.
enum class Text { kCorrected, kPrinted };

double Value(const BodyMeasure& measure, Sex sex, const std::string& column, Text text) {
  for (const PrintedValue& printed : measure.printed) {
    if (text == Text::kPrinted && printed.sex == sex && printed.column == column) {
      return printed.value;
    }
  }
  return measure.Of(sex)->Column(column);
}

const BodyMeasure& Find(const Table& table, const std::string& name) {
  return *std::find_if(table.begin(), table.end(),
                       [&name](const BodyMeasure& measure) { return measure.name == name; });
}

std::string NameOf(const BodyMeasure& measure, Sex sex) {
  return (sex == Sex::kFemale ? "female " : "male ") + measure.name;
}

/// Two digits, as the source prints its percentages.
double Rounded(double percent) { return std::round(100.0 * percent) / 100.0; }

bool IsSame(double one, double other) { return std::abs(one - other) < 1e-9; }

/// The source's "% from kph": mean and half the range of the ratios at P1, P5, P50 and P95.
std::pair<double, double> PercentOf(const Table& table, const BodyMeasure& measure, Sex sex,
                                    Text text) {
  std::array<double, 4> ratios{};
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    ratios[i] = 100.0 * Value(measure, sex, kColumns[i], text) /
                Value(Find(table, "kph"), sex, kColumns[i], text);
  }
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  return {Rounded((ratios[0] + ratios[1] + ratios[2] + ratios[3]) / 4.0),
          Rounded(0.5 * (*most - *least))};
}

/// "female usl" where percentage or half range do not follow from the row.
std::set<std::string> WrongPercentages(const Table& table, Text text) {
  std::set<std::string> wrong;
  for (const BodyMeasure& measure : table) {
    for (const Sex sex : kSexes) {
      if (!measure.Of(sex)) continue;
      const auto [percent, half_range] = PercentOf(table, measure, sex, text);
      if (!IsSame(percent, Value(measure, sex, "percent", text)) ||
          !IsSame(half_range, Value(measure, sex, "half_range", text))) {
        wrong.insert(NameOf(measure, sex));
      }
    }
  }
  return wrong;
}

double Median_mm(const Table& table, const BodyMeasure& measure, Sex sex);

double DerivedMedian_mm(const Table& table, const BodyMeasure& measure, Sex sex) {
  double sum_mm = 0.0;
  for (const Summand& summand : measure.derived) {
    sum_mm += summand.sign * Median_mm(table, Find(table, summand.of), sex);
  }
  return sum_mm;
}

double Median_mm(const Table& table, const BodyMeasure& measure, Sex sex) {
  return measure.Of(sex) ? measure.Of(sex)->p50 : DerivedMedian_mm(table, measure, sex);
}

/// Where the median is not the sum that the definition says.
std::set<std::string> WrongSums(const Table& table, Text text) {
  std::set<std::string> wrong;
  for (const BodyMeasure& measure : table) {
    for (const Sex sex : kSexes) {
      if (measure.derived.empty() || !measure.Of(sex)) continue;
      if (!IsSame(DerivedMedian_mm(table, measure, sex), Value(measure, sex, "p50", text))) {
        wrong.insert(NameOf(measure, sex));
      }
    }
  }
  return wrong;
}

/// Men's lower leg, where the source repeats another row: P1 is sound, P50 derived, the others lie
/// on the normal distribution through both.
bool IsLowerLegOfMenDerived(const Table& table) {
  const Percentiles& row = *Find(table, "usl").male;
  const double spread_mm = (row.p50 - row.p1) / 2.326;
  return row.p5 == std::round(row.p50 - 1.645 * spread_mm) &&
         row.p95 == std::round(row.p50 + 1.645 * spread_mm) &&
         row.p99 == std::round(row.p50 + 2.326 * spread_mm);
}

/// Sums of what the source prints; they were counted from a second transcription.
std::set<std::string> WrongColumns(const Table& table) {
  const std::map<Sex, std::array<double, 7>> sums{
      {Sex::kFemale, {15569, 16068, 17395, 18671, 19211, 1030.69, 21.77}},
      {Sex::kMale, {16794, 17407, 18765, 20226, 20977, 1035.83, 21.73}}};
  std::set<std::string> wrong;
  for (const Sex sex : kSexes) {
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      double sum = 0.0;
      for (const BodyMeasure& measure : table) {
        if (measure.Of(sex)) sum += Value(measure, sex, kColumns[i], Text::kPrinted);
      }
      if (std::abs(sum - sums.at(sex)[i]) > 1e-6) wrong.insert(kColumns[i]);
    }
  }
  return wrong;
}

/// Whether each number follows from others as the README says.
bool IsDerived(const Table& table) {
  return WrongSums(table, Text::kCorrected).empty() &&
         WrongPercentages(table, Text::kCorrected).empty() &&
         WrongSums(table, Text::kPrinted) == kWrongSums &&
         WrongPercentages(table, Text::kPrinted).empty() && IsLowerLegOfMenDerived(table);
}

/// One number of the file, and the digits after its point.
struct Cell {
  std::string name;
  double* value;
  int decimals;
};

std::vector<Cell> CellsOf(Table& table) {
  const auto decimals = [](const std::string& column) {
    return column[0] == 'p' && column != "percent" ? 0 : 2;
  };
  std::vector<Cell> cells;
  for (BodyMeasure& measure : table) {
    for (auto* row : {&measure.female, &measure.male}) {
      if (!*row) continue;
      double* const values[] = {&(*row)->p1,  &(*row)->p5,      &(*row)->p50,       &(*row)->p95,
                                &(*row)->p99, &(*row)->percent, &(*row)->half_range};
      for (std::size_t i = 0; i < kColumns.size(); ++i) {
        cells.push_back({measure.name + " " + kColumns[i], values[i], decimals(kColumns[i])});
      }
    }
    for (PrintedValue& printed : measure.printed) {
      cells.push_back(
          {measure.name + " printed " + printed.column, &printed.value, decimals(printed.column)});
    }
  }
  return cells;
}

/// What the number is when one of its digits is another one, each in turn.
std::vector<double> WithOneOtherDigit(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  const std::string digits = std::to_string(std::lround(value * scale));
  std::vector<double> changed;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    for (char digit = '0'; digit <= '9'; ++digit) {
      if (digit == digits[i]) continue;
      std::string other = digits;
      other[i] = digit;
      changed.push_back(std::stod(other) / scale);
    }
  }
  return changed;
}

/// Names of the numbers of which some other digit passes `judge`.
template <typename Judge>
std::set<std::string> Unnoticed(const Judge& judge) {
  Table table = Shipped().all();
  std::set<std::string> unnoticed;
  for (const Cell& cell : CellsOf(table)) {
    const double value = *cell.value;
    for (const double other : WithOneOtherDigit(value, cell.decimals)) {
      *cell.value = other;
      if (judge(table)) unnoticed.insert(cell.name);
    }
    *cell.value = value;
  }
  return unnoticed;
}

TEST(SourceTables, AreComplete) {
  EXPECT_EQ(Shipped().all().size(), 34u);
  const auto rows =
      std::count_if(Shipped().all().begin(), Shipped().all().end(),
                    [](const BodyMeasure& measure) { return measure.female && measure.male; });
  EXPECT_EQ(rows, 33);
  const auto sitting = std::count_if(
      Shipped().all().begin(), Shipped().all().end(),
      [](const BodyMeasure& measure) { return measure.posture == MeasuringPosture::kSitting; });
  EXPECT_EQ(sitting, 7);
  EXPECT_EQ(Shipped().Find("kph")->female->p99, 1804.0);
  EXPECT_EQ(Shipped().Find("usfl")->male->p1, 412.0);
}

TEST(SourceTables, ContradictNothingOnceCorrected) {
  EXPECT_THAT(WrongSums(Shipped().all(), Text::kCorrected), testing::IsEmpty());
  EXPECT_THAT(WrongPercentages(Shipped().all(), Text::kCorrected), testing::IsEmpty());
  EXPECT_TRUE(IsLowerLegOfMenDerived(Shipped().all()));
}

TEST(SourceTables, AreContradictedByWhatIsPrintedInTheseSumsOnly) {
  EXPECT_EQ(WrongSums(Shipped().all(), Text::kPrinted), kWrongSums);
  EXPECT_THAT(WrongPercentages(Shipped().all(), Text::kPrinted), testing::IsEmpty());
}

TEST(SourceTables, AddUpToTheSumsOfThePrintedColumns) {
  EXPECT_THAT(WrongColumns(Shipped().all()), testing::IsEmpty());
}

TEST(SourceTables, FollowFromEachOtherButForTheLastPercentile) {
  const std::set<std::string> unnoticed = Unnoticed(IsDerived);
  EXPECT_EQ(unnoticed.size(), 33u + 1u);  // And the printed one of usl.
  EXPECT_THAT(unnoticed, testing::Each(testing::EndsWith(" p99")));
}

TEST(SourceTables, HaveNoDigitThatCouldBeAnotherUnnoticed) {
  const auto unnoticed =
      Unnoticed([](const Table& table) { return WrongColumns(table).empty() && IsDerived(table); });
  EXPECT_THAT(unnoticed, testing::IsEmpty());
}

TEST(SourceTables, CopyOneRowIntoAnotherOnlyOnce) {
  std::vector<std::string> copies;
  for (const BodyMeasure& one : Shipped().all()) {
    for (const BodyMeasure& other : Shipped().all()) {
      for (const Sex sex : kSexes) {
        if (one.name >= other.name || !one.Of(sex) || !other.Of(sex)) continue;
        const auto same =
            std::count_if(kColumns.begin(), kColumns.begin() + 5, [&](const std::string& column) {
              return Value(one, sex, column, Text::kPrinted) ==
                     Value(other, sex, column, Text::kPrinted);
            });
        if (same >= 3) copies.push_back(NameOf(one, sex) + " = " + other.name);
      }
    }
  }
  EXPECT_THAT(copies, testing::ElementsAre("male kgh = usl"));
}

TEST(SourceTables, LetStandingAndSittingHeightsDifferByTheLeg) {
  const std::pair<const char*, const char*> heights[] = {
      {"kph", "stl"}, {"auh", "auhs"}, {"sha", "shas"}, {"ebh", "ebhs"}};
  for (const auto& [standing, sitting] : heights) {
    for (const Sex sex : kSexes) {
      EXPECT_NEAR(Shipped().Median_mm(standing, sex) - Shipped().Median_mm(sitting, sex),
                  Shipped().Median_mm("blp", sex), 8.5)
          << standing;
    }
  }
}

TEST(SourceTables, HaveMenLargerThanWomenButForTheHips) {
  std::vector<std::string> smaller;
  for (const BodyMeasure& measure : Shipped().all()) {
    if (Shipped().Median_mm(measure.name, Sex::kMale) <=
        Shipped().Median_mm(measure.name, Sex::kFemale)) {
      smaller.push_back(measure.name);
    }
  }
  EXPECT_THAT(smaller, testing::ElementsAre("hueb"));
}

}  // namespace
}  // namespace deixis::anthropometry
