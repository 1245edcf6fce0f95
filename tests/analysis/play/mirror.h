#pragma once
// A toy player that writes down how it was asked, beside others or alone.

#include <folk/strategies/registry.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace folk::test {

/// What the toy players of one strategy saw.
struct Diary {
  std::size_t alive = 0;
  std::size_t most_alive = 0;
  std::size_t thoughts = 0;
  std::size_t largest_group = 0;
  unsigned threads = 0;
};

/// Plays tit for tat and expects the other to repeat its move (C at first).
class Mirror final : public Player {
public:
  explicit Mirror(std::shared_ptr<Diary> diary)
      : diary_(std::move(diary)) {
    diary_->most_alive = std::max(diary_->most_alive, ++diary_->alive);
  }
  ~Mirror() override { --diary_->alive; }
  Mirror(const Mirror&) = delete;
  Mirror& operator=(const Mirror&) = delete;

  void start(const MatchStart&) override {
    last_ = Move::C;
    round_ = 0;
  }
  Move move() override {
    EXPECT_EQ(thought_of_, together_ ? round_ : thought_of_) << "everybody was told before it moved";
    return last_;
  }
  void observe(Move, Move theirs) override {
    last_ = theirs;
    ++round_;
  }
  std::optional<double> belief() const override { return last_ == Move::C ? 0.5 : 0.1; }

  void think_together(std::span<Player* const> peers, unsigned threads) override {
    EXPECT_TRUE(std::find(peers.begin(), peers.end(), this) != peers.end());
    EXPECT_EQ(std::set<Player*>(peers.begin(), peers.end()).size(), peers.size());
    for (Player* peer : peers) {
      auto& mirror = dynamic_cast<Mirror&>(*peer);
      EXPECT_EQ(mirror.round_, round_) << "all are in the same round";
      mirror.thought_of_ = round_;
      mirror.together_ = true;
    }
    ++diary_->thoughts;
    diary_->largest_group = std::max(diary_->largest_group, peers.size());
    diary_->threads = threads;
  }

private:
  std::shared_ptr<Diary> diary_;
  Move last_ = Move::C;
  std::size_t round_ = 0;
  std::size_t thought_of_ = 0;
  bool together_ = false;
};

inline Strategy mirror(const std::shared_ptr<Diary>& diary, bool deterministic, bool thinks_together) {
  Strategy strategy{"mirror", nullptr, [diary] { return std::make_unique<Mirror>(diary); }};
  strategy.deterministic = deterministic;
  strategy.thinks_together = thinks_together;
  return strategy;
}

/// The same strategy without a machine to look into.
inline Strategy opaque(const std::string& name) {
  const auto machine = Registry::standard().make(name).machine;
  return {"opaque " + name, nullptr, [machine] { return play(machine); }};
}

inline std::vector<Strategy> with_classics(const Strategy& strategy) {
  auto roster = Registry::standard().roster("classics,random(0.3)");
  roster.push_back(strategy);
  return roster;
}

}  // namespace folk::test
