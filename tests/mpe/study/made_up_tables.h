#pragma once
// Small tables of the study, written by hand, for the tests of its reports.

#include <folk/mpe/study/study_tables.h>

namespace folk::mpe::test {

inline constexpr std::size_t radii = belief_radii.size();

/// simple_world and simple_tag, the preys released and still: SCT of three seeds, MADT of one, OMAR not run; who made
/// the data; a rule.
inline StudyTables made_up_tables() {
  StudyTables tables;
  tables.data_prey = "released";
  tables.budget = "small";
  tables.scores = {
      {"simple_world", "expert", "omar", "released", {}, {}, {}, 114.25, 3.5},
      {"simple_tag", "expert", "sct", "released", Cell{103.21349, 8.25, 3}, Cell{101.5, 9, 3}, Cell{99.25, 7, 3},
       121.13, 8.25},
      {"simple_tag", "expert", "sct", "still", Cell{-0.00001, 4, 3}, Cell{-12.5, 4, 3}, {}, -1.5, 2},
      {"simple_tag", "expert", "madt", "released", Cell{90, 2, 1}, {}, {}, {}, {}},
      {"simple_tag", "random", "sct", "released", {}, {}, {}, 24.8, 2.7},
  };
  tables.players = {{"simple_tag", "none", "lead_pursuit", "released", Cell{123.5, 1, 1}, {}, {}, {}, {}},
                    {"simple_tag", "expert", "matd3", "released", Cell{99.5, 1.5, 1}, {}, {}, {}, {}}};
  AccuracyRow right{"simple_tag", "expert", "sct", "released", Cell{0.875, 0.01, 3}, {}, {}, Cell{0.25, 0.01, 3}, 1.0};
  right.right = {Cell{0.5, 0.01, 3}, right.accuracy, Cell{0.9375, 0.01, 3}, Cell{1, 0, 3}};
  right.within = {Cell{0.75, 0.01, 3}, Cell{0.8125, 0.01, 3}, Cell{0.984375, 0.005, 3}};
  AccuracyRow missing{"simple_tag", "expert", "rmadt", "released", {}, {}, {}, {}, {}};
  missing.right.resize(radii);
  missing.within.resize(absolute_radii.size());
  tables.accuracies = {missing, right};
  tables.blends = {{"simple_tag", "none", "lead_pursuit", 1, Cell{123.5, 1, 1}},
                   {"simple_tag", "none", "lead_pursuit", 0.3, Cell{70, 1, 1}},
                   {"simple_tag", "expert", "sct", 1, Cell{103.25, 8.25, 3}},
                   {"simple_tag", "expert", "sct", 0.3, Cell{40.5, 2, 3}},
                   {"simple_tag", "expert", "omar", 1, {}},
                   {"simple_tag", "expert", "omar", 0.3, {}}};
  tables.forced = {
      {"simple_tag", "expert", "sct", "still", "none", Cell{50, 3, 3}, Cell{0, 0, 3}, Cell{0, 0, 3}},
      {"simple_tag", "expert", "sct", "still", "truth", Cell{55, 3, 3}, Cell{5, 1, 3}, Cell{0.125, 0.01, 3}},
      {"simple_tag", "expert", "sct-selfconf", "still", "none", {}, {}, {}}};
  tables.asked = {{"simple_tag", "expert", "sct", "released", 80, Cell{60, 5, 3}, Cell{0.5, 0.1, 3}},
                  {"simple_tag", "expert", "madt", "released", 80, Cell{61, 5, 1}, {}},
                  {"simple_tag", "expert", "rmadt", "released", 80, {}, {}}};
  tables.paired = {{"simple_tag", "expert", "released", "omar", {}},
                   {"simple_tag", "expert", "released", "madt", Cell{13.25, 2.5, 1}},
                   {"simple_tag", "expert", "still", "omar", {}},
                   {"simple_tag", "expert", "still", "madt", Cell{-0.00001, 1, 3}}};
  tables.diverged = {"released-simple_tag-medium-omar-1: training has diverged"};
  tables.data_returns = {{"simple_tag-expert", 185.5}};
  tables.data_prey_returns = {{"simple_tag-expert-sct", Cell{190.5, 12, 3}},
                              {"simple_tag-none-lead_pursuit", Cell{230.25, 2, 1}}};
  return tables;
}

/// The same of data with another prey, which the paper does not have.
inline StudyTables made_up_second_tables() {
  StudyTables tables = made_up_tables();
  tables.data_prey = "maddpg";
  for (auto& row : tables.scores) row.paper = row.paper_sd = std::nullopt;
  for (auto& row : tables.accuracies) row.paper = std::nullopt;
  return tables;
}

}  // namespace folk::mpe::test
