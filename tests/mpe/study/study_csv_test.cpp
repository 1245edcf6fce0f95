#include <folk/mpe/study/study_csv.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "mpe/study/made_up_tables.h"

namespace folk::mpe {
namespace {

using test::made_up_second_tables;
using test::made_up_tables;
using Row = std::map<std::string, std::string>;

/// The fields of a line; an empty one at its end too.
std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  }
  return fields;
}

/// A CSV read back: rows by the names of their columns. Every line must have all fields.
std::vector<Row> read(const std::string& text) {
  EXPECT_TRUE(text.ends_with("\n"));
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  const auto header = fields_of(line);
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    const auto fields = fields_of(line);
    EXPECT_EQ(fields.size(), header.size()) << line;
    Row row;
    for (std::size_t i = 0; i < std::min(fields.size(), header.size()); ++i) row[header[i]] = fields[i];
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string header_of(const std::string& text) { return text.substr(0, text.find('\n')); }

TEST(StudyCsv, ScoresHaveTheirColumnsFirst) {
  const std::string header = header_of(scores_csv(made_up_tables()));
  EXPECT_TRUE(header.starts_with("scenario,level,learner,prey,score,ci95,seeds,budget,")) << header;
  EXPECT_EQ(header_of(accuracy_csv(made_up_tables())),
            "scenario,level,learner,prey,accuracy,ci95,seeds,budget,within_5,within_20,within_50,within_0.1,"
            "within_0.3,within_0.6,distance,paper");
  EXPECT_EQ(header_of(paired_csv(made_up_tables())), "scenario,level,prey,minus,difference,ci95,seeds,budget");
  EXPECT_EQ(header_of(blend_csv(made_up_tables())), "scenario,level,learner,p,score,ci95,seeds,budget");
}

TEST(StudyCsv, ScoresStandBesideThePapers) {
  const auto rows = read(scores_csv(made_up_tables()));
  ASSERT_EQ(rows.size(), 5U);
  EXPECT_EQ(rows[1], (Row{{"scenario", "simple_tag"},
                          {"level", "expert"},
                          {"learner", "sct"},
                          {"prey", "released"},
                          {"score", "103.2135"},
                          {"ci95", "8.2500"},
                          {"seeds", "3"},
                          {"budget", "small"},
                          {"at_data_target", "101.5000"},
                          {"at_data_target_ci95", "9.0000"},
                          {"at_own_target", "99.2500"},
                          {"at_own_target_ci95", "7.0000"},
                          {"paper", "121.13"},
                          {"paper_sd", "8.25"},
                          {"to_paper", "below"}}));
  EXPECT_EQ(rows[2].at("score"), "0.0000");  // without the sign of what was rounded away
  EXPECT_EQ(rows[2].at("at_data_target"), "-12.5000");
  EXPECT_EQ(rows[2].at("at_own_target"), "");
  EXPECT_EQ(rows[2].at("to_paper"), "alike");
  EXPECT_EQ(rows[3].at("seeds"), "1");
  EXPECT_EQ(rows[3].at("at_data_target"), "");
  EXPECT_EQ(rows[3].at("paper"), "");
  EXPECT_EQ(rows[3].at("to_paper"), "");
}

TEST(StudyCsv, WhatWasNotRunHasNoNumbers) {
  const auto omar = read(scores_csv(made_up_tables()))[0];
  EXPECT_EQ(omar.at("learner"), "omar");
  for (const char* column : {"score", "ci95", "at_data_target", "at_data_target_ci95", "at_own_target", "to_paper"})
    EXPECT_EQ(omar.at(column), "") << column;
  EXPECT_EQ(omar.at("seeds"), "0");
  EXPECT_EQ(omar.at("budget"), "small");
  EXPECT_EQ(omar.at("paper"), "114.25");
  const auto accuracy = read(accuracy_csv(made_up_tables()))[0];
  for (const char* column : {"accuracy", "ci95", "within_5", "within_20", "within_50", "within_0.1", "within_0.3",
                             "within_0.6", "distance", "paper"})
    EXPECT_EQ(accuracy.at(column), "") << column;
  EXPECT_EQ(accuracy.at("seeds"), "0");
}

TEST(StudyCsv, AccuraciesHaveAllRadii) {
  const auto row = read(accuracy_csv(made_up_tables()))[1];
  const std::map<std::string, std::string> expected{
      {"within_5", "0.500000"},   {"accuracy", "0.875000"},   {"within_20", "0.937500"},
      {"within_50", "1.000000"},  {"within_0.1", "0.750000"}, {"within_0.3", "0.812500"},
      {"within_0.6", "0.984375"}, {"distance", "0.250000"},   {"paper", "1"}};
  for (const auto& [column, value] : expected) EXPECT_EQ(row.at(column), value) << column;
}

TEST(StudyCsv, OthersHaveTheirNumbers) {
  const auto tables = made_up_tables();
  const auto blend = read(blend_csv(tables));
  ASSERT_EQ(blend.size(), 6U);
  EXPECT_EQ(blend[3].at("p"), "0.3");
  EXPECT_EQ(blend[3].at("score"), "40.5000");
  EXPECT_EQ(blend[4].at("seeds"), "0");
  const auto paired = read(paired_csv(tables));
  ASSERT_EQ(paired.size(), 4U);
  EXPECT_EQ(paired[1], (Row{{"scenario", "simple_tag"},
                            {"level", "expert"},
                            {"prey", "released"},
                            {"minus", "madt"},
                            {"difference", "13.2500"},
                            {"ci95", "2.5000"},
                            {"seeds", "1"},
                            {"budget", "small"}}));
  EXPECT_EQ(paired[2].at("difference"), "");
  EXPECT_EQ(paired[2].at("seeds"), "0");
  EXPECT_EQ(paired[3].at("difference"), "0.0000");
  const auto players = read(players_csv(tables));
  ASSERT_EQ(players.size(), 2U);
  EXPECT_EQ(players[0].at("level"), "none");
  EXPECT_EQ(players[0].at("score"), "123.5000");
  const auto forced = read(beliefs_forced_csv(tables));
  ASSERT_EQ(forced.size(), 3U);
  EXPECT_EQ(forced[1].at("belief"), "truth");
  EXPECT_EQ(forced[1].at("difference"), "5.0000");
  EXPECT_EQ(forced[1].at("change"), "0.125000");
  EXPECT_EQ(forced[2].at("change_ci95"), "");
  const auto asked = read(returns_asked_csv(tables));
  ASSERT_EQ(asked.size(), 3U);
  EXPECT_EQ(asked[0].at("asked"), "80");
  EXPECT_EQ(asked[0].at("accuracy"), "0.500000");
  EXPECT_EQ(asked[1].at("accuracy"), "");
  EXPECT_EQ(asked[1].at("score"), "61.0000");
}

TEST(StudyCsv, ReturnsAreOfWhomTheTablesSpeak) {
  const auto rows = read(returns_csv(made_up_tables()));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].at("learner"), "lead_pursuit");
  EXPECT_EQ(rows[0].at("return"), "230.2500");
  EXPECT_EQ(rows[0].at("data_return"), "");
  EXPECT_EQ(rows[1].at("learner"), "sct");
  EXPECT_EQ(rows[1].at("return"), "190.5000");
  EXPECT_EQ(rows[1].at("data_return"), "185.5000");
  EXPECT_EQ(rows[2].at("return"), "");
  EXPECT_EQ(rows[2].at("seeds"), "0");
}

TEST(StudyCsv, FilesOfTheSecondTableHaveOtherNames) {
  std::vector<std::string> names;
  for (const auto& file : study_csv_files(made_up_tables())) names.push_back(file.name);
  EXPECT_EQ(names, (std::vector<std::string>{"scores.csv", "paired.csv", "players.csv", "accuracy.csv", "blend.csv",
                                             "beliefs_forced.csv", "returns_asked.csv", "returns.csv"}));
  const auto second = study_csv_files(made_up_second_tables());
  EXPECT_EQ(second[0].name, "trained_prey_scores.csv");
  EXPECT_EQ(second[1].name, "trained_prey_paired.csv");
  EXPECT_EQ(header_of(second[0].text), header_of(scores_csv(made_up_tables())));
  EXPECT_EQ(read(second[0].text)[1].at("paper"), "");
}

TEST(StudyCsv, NothingIsAHeader) { EXPECT_TRUE(read(scores_csv(StudyTables{})).empty()); }

}  // namespace
}  // namespace folk::mpe
