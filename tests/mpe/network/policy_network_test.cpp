// Networks that act: the prey of the published program against what it answered, and how numbers become actions.

#include <folk/games/random.h>
#include <folk/mpe/network/policy_network.h>
#include <folk/mpe/players/policy_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace folk::mpe {
namespace {

namespace fs = std::filesystem;

/// Observations and answers of the published prey: all hundred where the reference folder is, else twenty.
class Pairs {
public:
  explicit Pairs(const std::string& file) {
    const char* folder = std::getenv("FOLK_REFERENCE");
    const fs::path root = folder != nullptr ? folder : FOLK_SOURCE_DIR "/../shared/reference";
    const fs::path whole = root / "mpe/prey" / file;
    std::ifstream stream(fs::exists(whole) ? whole : fs::path(FOLK_SOURCE_DIR "/tests/data/mpe") / file);
    std::string line, field;
    std::getline(stream, line);
    std::stringstream names(line);
    for (std::size_t column = 0; std::getline(names, field, ',');) columns_[field] = column++;
    while (std::getline(stream, line)) {
      std::stringstream fields(line);
      auto& row = rows_.emplace_back();
      while (std::getline(fields, field, ',')) row.push_back(std::stod(field));
    }
  }

  std::size_t rows() const { return rows_.size(); }
  double at(std::size_t row, const std::string& column) const { return rows_[row].at(columns_.at(column)); }

private:
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<double>> rows_;
};

PolicyNetwork prey_of(const std::string& scenario) {
  return read_policy(FOLK_SOURCE_DIR "/data/mpe/" + scenario + "_released.safetensors").networks.at(0);
}

/// Expects of every observation the numbers of the last layer, and the actions, that the columns hold.
template <class S>
void expect_answers(const PolicyNetwork& network, const Pairs& pairs, const std::string& raw,
                    const std::string& actions, double tolerance) {
  ASSERT_GE(pairs.rows(), 20U);
  Actor<S> actor(network);
  auto& observations = actor.observations(pairs.rows());
  ASSERT_EQ(static_cast<std::size_t>(observations.cols()), actor.inputs());
  for (std::size_t row = 0; row < pairs.rows(); ++row)
    for (std::size_t k = 0; k < actor.inputs(); ++k)
      observations(index(row), index(k)) = static_cast<S>(pairs.at(row, "obs" + std::to_string(k)));
  const auto& found = actor.act();
  ASSERT_EQ(found.cols(), 2);
  for (std::size_t row = 0; row < pairs.rows(); ++row)
    for (const Index axis : {0, 1}) {
      const std::string ending = axis == 0 ? "_x" : "_y";
      const double z = pairs.at(row, raw + ending);  // up to 13
      EXPECT_NEAR(static_cast<double>(actor.raw()(index(row), axis)), z, tolerance * std::max(1.0, std::abs(z))) << row;
      EXPECT_NEAR(static_cast<double>(found(index(row), axis)), pairs.at(row, actions + ending), tolerance) << row;
    }
}

void expect_published_answers(const std::string& short_name, const std::string& scenario) {
  const Pairs pairs(short_name + "_prey_pairs.csv");
  auto network = prey_of(scenario);
  expect_answers<float>(network, pairs, "z32", "act32", 1e-6);
  expect_answers<double>(network, pairs, "z64", "act64", 1e-12);
  network.squash = Squash::tanh;
  expect_answers<double>(network, pairs, "z64", "tanh64", 1e-12);
}

TEST(PublishedPrey, OfSimpleTagAnswersAsItDid) { expect_published_answers("tag", "simple_tag"); }
TEST(PublishedPrey, OfSimpleWorldAnswersAsItDid) { expect_published_answers("world", "simple_world"); }

// Rows of the other forms of a pass: one alone, the same twice, more rows than before.
TEST(Actor, ActsOnARowTheSameWhateverElseItIsAsked) {
  const auto network = prey_of("simple_tag");
  Actor<float> actor(network);
  RandomStream random;
  Matrix<float> all(70, 14);
  for (Index i = 0; i < all.size(); ++i) all.data()[i] = static_cast<float>(random.normal());
  actor.observations(70) = all;
  const Matrix<float> together = actor.act();
  for (const Index count : {1, 3, 69, 70, 2}) {
    auto& observations = actor.observations(static_cast<std::size_t>(count));
    ASSERT_EQ(observations.rows(), count);
    observations = all.topRows(count);
    EXPECT_EQ(actor.act(), together.topRows(count)) << count;
  }
  EXPECT_FALSE(together.row(0) == together.row(1));
}

TEST(Actor, NormalisesItsInputs) {
  PolicyNetwork network;
  network.shape = MlpShape({1, 2});
  network.parameters = {1, -1, 0.25F, 0};
  network.normalisation = InputNormalisation{{3}, {0.5F}, {2}, {4 - 1e-5F}, 1e-5};
  network.squash = Squash::clamp;
  Actor<double> actor(network);
  actor.observations(1)(0, 0) = 2.25;
  const auto actions = actor.act();  // (2.25 - 2) / 2 * 3 + 0.5 = 0.875
  EXPECT_NEAR(actor.raw()(0, 0), 1.125, 1e-6);
  EXPECT_EQ(actions(0, 0), 1);
  EXPECT_NEAR(actions(0, 1), -0.875, 1e-6);
}

TEST(Squash, ByTanhIsRightToTheLastPlaces) {
  RandomStream random;
  Matrix<double> raw(1000, 2);
  for (Index i = 0; i < raw.size(); ++i) raw.data()[i] = 25 * (2 * random.uniform() - 1) * random.uniform();
  raw(0, 0) = 0;
  raw(0, 1) = 1e-300;
  raw(1, 0) = 1e300;
  raw(1, 1) = -1e300;
  raw(2, 0) = std::numeric_limits<double>::infinity();
  Matrix<double> actions;
  squash(Squash::tanh, raw, actions);
  for (Index i = 0; i < raw.size(); ++i) {
    EXPECT_NEAR(actions.data()[i], std::tanh(raw.data()[i]), 3e-16) << raw.data()[i];
    EXPECT_LE(std::abs(actions.data()[i]), 1);
  }
  EXPECT_EQ(actions(0, 0), 0);
  Matrix<float> few(1, 2), found;  // fewer than a register holds
  few << 0.5F, -20000;
  squash(Squash::tanh, few, found);
  EXPECT_EQ(found(0, 0), static_cast<float>(std::tanh(0.5)));
  EXPECT_EQ(found(0, 1), -1);
}

TEST(Squash, ByClampCutsAndLeavesTheRest) {
  Matrix<float> raw(2, 2), actions;
  raw << 0.75F, -0.5F, 1.5F, -1e30F;
  squash(Squash::clamp, raw, actions);
  Matrix<float> wanted(2, 2);
  wanted << 0.75F, -0.5F, 1, -1;
  EXPECT_EQ(actions, wanted);
}

}  // namespace
}  // namespace folk::mpe
