#include <fmt/format.h>
#include <folk/games/error.h>
#include <folk/strategies/automaton.h>
#include <folk/strategies/memory_one.h>
#include <folk/strategies/names.h>
#include <folk/strategies/standard/named_machine.h>
#include <folk/strategies/standard/parametric_strategies.h>

#include <optional>
#include <utility>
#include <vector>

namespace folk {
namespace {

// ---- arguments ----

/// Arguments as text, split at ',' and ';', without the blanks around them; an empty one is kept.
std::vector<std::string> arguments_of(std::string_view text) {
  std::vector<std::string> arguments(1);
  for (const char c : text) {
    if (c == ',' || c == ';') {
      arguments.emplace_back();
    } else if (c != ' ') {
      arguments.back() += c;
    }
  }
  return arguments;
}

std::vector<Rational> probabilities(const std::vector<std::string>& arguments, std::size_t from,
                                    std::string_view what) {
  std::vector<Rational> values;
  for (std::size_t i = from; i < arguments.size(); ++i) values.push_back(parse_exact_number(arguments[i], what, 0, 1));
  return values;
}

/// Numbers as they stand in a name: "0.3,1/3".
template <class Numbers>
std::string listed(const Numbers& numbers) {
  std::string text;
  for (const Rational& number : numbers) {
    if (!text.empty()) text += ',';
    text += to_short_text(number);
  }
  return text;
}

void expect_count(const std::vector<std::string>& arguments, std::size_t least, std::size_t most,
                  const std::string& form) {
  if (arguments.size() < least || arguments.size() > most)
    throw UsageError(fmt::format("{} parameters given to {}", arguments.size(), form));
}

/// Registers a memory-one strategy whose parameters are all probabilities.
template <class Make>
void add_mixed(Registry& registry, Description description, std::size_t count, Make make) {
  const std::string form = description.name;
  const std::string head = form.substr(0, form.find('('));
  registry.add(std::move(description), [=](const std::string&, std::string_view text, const Payoffs&) {
    const auto arguments = arguments_of(text);
    expect_count(arguments, count, count, form);
    const auto exact = probabilities(arguments, 0, form);
    std::vector<double> p;
    for (const Rational& number : exact) p.push_back(to_double(number));
    return named_machine(fmt::format("{}({})", head, listed(exact)), make(p));
  });
}

void add_zero_determinant(Registry& registry, Description description, Baseline baseline) {
  const std::string form = description.name;
  const std::string head = form.substr(0, form.find('('));
  registry.add(std::move(description), [=](const std::string&, std::string_view text, const Payoffs& payoffs) {
    const auto arguments = arguments_of(text);
    expect_count(arguments, 1, 2, form);
    const Rational chi = parse_exact_number(arguments[0], form + " chi", 1, 1e6);
    if (arguments.size() == 1)
      return named_machine(fmt::format("{}({})", head, to_short_text(chi)),
                           memory_one(1, zero_determinant(payoffs, baseline, chi)));
    const Rational phi = parse_exact_number(arguments[1], form + " phi", 0, 1e6);
    return named_machine(fmt::format("{}({};{})", head, to_short_text(chi), to_short_text(phi)),
                         memory_one(1, zero_determinant(payoffs, baseline, chi, phi)));
  });
}

}  // namespace

Strategy memory_one_strategy(const Rational& first, const std::array<Rational, 4>& p) {
  const std::string opening = first == 1 ? "c" : first == 0 ? "d" : to_short_text(first);
  return named_machine(
      fmt::format("mem1({};{})", opening, listed(p)),
      memory_one(to_double(first), {to_double(p[0]), to_double(p[1]), to_double(p[2]), to_double(p[3])}));
}

void add_parametric(Registry& registry) {
  add_mixed(registry, {"random(p)", {}, "C with probability p", "Mathieu & Delahaye, JASSS 20(4) 12, 2017"}, 1,
            [](const std::vector<double>& p) {
              return Automaton({{p[0], {0, 0, 0, 0}}}, 0);
            });
  registry.add({"mem1(first;pCC,pCD,pDC,pDD)",
                {},
                "first c, d or a probability; then C by the last round (own, their)",
                "Nowak & Sigmund, Acta Applicandae Mathematicae 20, 1990"},
               [](const std::string& form, std::string_view text, const Payoffs&) {
                 const auto arguments = arguments_of(text);
                 expect_count(arguments, 5, 5, form);
                 const std::string opening = name_key(arguments[0]);
                 const Rational first = opening == "c"   ? Rational(1)
                                        : opening == "d" ? Rational(0)
                                                         : parse_exact_number(arguments[0], "first move", 0, 1);
                 const auto p = probabilities(arguments, 1, form);
                 return memory_one_strategy(first, {p[0], p[1], p[2], p[3]});
               });
  add_mixed(
      registry,
      {"gtft(q)", {}, "C; after their C: C; after their D: C with probability q", "Nowak & Sigmund, Nature 355, 1992"},
      1, [](const std::vector<double>& q) {
        return memory_one(1, {1, q[0], 1, q[0]});
      });
  add_mixed(registry,
            {"joss(p)",
             {},
             "tit_for_tat that plays D instead of C (the first C too) with probability 1 - p",
             "Axelrod, Journal of Conflict Resolution 24, 1980"},
            1, [](const std::vector<double>& p) {
              return memory_one(p[0], {p[0], 0, p[0], 0});
            });
  add_zero_determinant(
      registry,
      {"zd_extort(chi;phi)", {}, "C; then own payoff - P = chi (their payoff - P)", "Press & Dyson, PNAS 109, 2012"},
      Baseline::punishment);
  add_zero_determinant(registry,
                       {"zd_generous(chi;phi)",
                        {},
                        "C; then own payoff - R = chi (their payoff - R)",
                        "Stewart & Plotkin, PNAS 110, 2013"},
                       Baseline::reward);
  registry.add({"equalizer(v;pCC,pDD)",
                {},
                "C; then their long-run payoff is v whatever they play",
                "Press & Dyson, PNAS 109, 2012"},
               [](const std::string& form, std::string_view text, const Payoffs& payoffs) {
                 const auto arguments = arguments_of(text);
                 expect_count(arguments, 1, 3, form);
                 const Rational v = parse_exact_number(arguments[0], form + " v", -1e6, 1e6);
                 const auto p = probabilities(arguments, 1, form);
                 const auto given = [&](std::size_t i) { return i < p.size() ? std::optional(p[i]) : std::nullopt; };
                 return named_machine(p.empty() ? fmt::format("equalizer({})", to_short_text(v))
                                                : fmt::format("equalizer({};{})", to_short_text(v), listed(p)),
                                      memory_one(1, equalizer(payoffs, v, given(0), given(1))));
               });
}

}  // namespace folk
