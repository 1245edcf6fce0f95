// A small mutational fuzzer for compilers without libFuzzer: fuzz_NAME [INPUTS [SEED [CORPUS_FOLDER...]]].
// The same arguments give the same inputs. A target that defines LLVMFuzzerCustomMutator makes half of them. A crash
// prints the input that caused it and ends with a status other than 0.

#include <folk/games/random.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
// Defined by targets that know the form of their inputs: changes `data` in place, up to `most` bytes.
extern "C" __attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                                                     std::size_t most, unsigned seed);
// Defined when a sanitizer is linked in.
extern "C" __attribute__((weak)) void __sanitizer_set_death_callback(void (*callback)());

namespace {

constexpr std::size_t longest_input = 4096;

std::string current_input;
std::uint64_t current_number = 0;

/// The input that is being tried, as a C string literal.
void print_input() {
  std::fprintf(stderr, "\ncrash on input %llu, %zu bytes: \"", static_cast<unsigned long long>(current_number),
               current_input.size());
  for (const char c : current_input) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte < 0x7F && byte != '"' && byte != '\\')
      std::fputc(byte, stderr);
    else
      std::fprintf(stderr, "\\%03o", static_cast<unsigned>(byte));
  }
  std::fputs("\"\n", stderr);
}

extern "C" void on_signal(int signal) {
  print_input();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

std::vector<std::string> read_corpus(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file()) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());  // a folder lists its files in any order
  std::vector<std::string> seeds;
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    seeds.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return seeds;
}

/// Words and marks of the seeds, and what has broken parsers before.
std::vector<std::string> dictionary(const std::vector<std::string>& seeds) {
  std::vector<std::string> tokens{"nan", "inf", "-1",   "0",    "1e30",   "1e-400", "1.5", "18446744073709551616",
                                  "\n",  "\r",  "\xFF", "\xC3", "\\\"",   "-",      "+",   std::string(1, '\0'),
                                  " ",   "/0",  "%s",   "\x1b", "999999", "((((",   "))",  std::string(300, '9')};
  for (const std::string& seed : seeds) {
    std::string word;
    for (const char c : seed + ' ') {
      if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
        word += c;
        continue;
      }
      if (!word.empty()) tokens.push_back(word);
      tokens.emplace_back(1, c);
      word.clear();
    }
  }
  std::sort(tokens.begin(), tokens.end());
  tokens.erase(std::unique(tokens.begin(), tokens.end()), tokens.end());
  return tokens;
}

/// Makes inputs from seeds by small random changes.
class Mutator {
public:
  Mutator(std::vector<std::string> seeds, std::uint64_t seed)
      : seeds_(std::move(seeds)),
        tokens_(dictionary(seeds_)),
        random_({.seed = seed}) {
    if (seeds_.empty()) seeds_.emplace_back();
  }

  /// The seeds themselves first, then what became of them.
  std::string input(std::uint64_t number) {
    if (number < seeds_.size()) return seeds_[number];
    std::string text = pick(seeds_);
    if (LLVMFuzzerCustomMutator != nullptr && number % 2 == 0) return by_target(std::move(text));
    const std::size_t changes = 1 + below(random_.chance(0.1) ? 24 : 5);
    for (std::size_t i = 0; i < changes; ++i) change(text);
    text.resize(std::min(text.size(), longest_input));
    return text;
  }

private:
  std::size_t below(std::size_t bound) { return static_cast<std::size_t>(random_() % bound); }

  const std::string& pick(const std::vector<std::string>& from) { return from[below(from.size())]; }

  /// A random part of a text: where it begins and how long it is, mostly short.
  std::pair<std::size_t, std::size_t> part(const std::string& text) {
    const std::size_t begin = below(text.size() + 1);
    const std::size_t most = random_.chance(0.2) ? text.size() - begin : std::min<std::size_t>(8, text.size() - begin);
    return {begin, below(most + 1)};
  }

  std::string by_target(std::string text) {
    const std::size_t size = text.size();
    text.resize(std::max(size, longest_input));
    text.resize(LLVMFuzzerCustomMutator(reinterpret_cast<std::uint8_t*>(text.data()), size, text.size(),
                                        static_cast<unsigned>(random_())));
    return text;
  }

  void change(std::string& text) {
    const auto [begin, length] = part(text);
    switch (below(8)) {
      case 0: text.erase(begin, length); break;
      case 1: text.insert(begin, 1, static_cast<char>(random_())); break;
      case 2: text.insert(begin, pick(tokens_)); break;
      case 3: text.replace(begin, length, pick(tokens_)); break;
      case 4: text.insert(below(text.size() + 1), text.substr(begin, length)); break;
      case 5:
        if (begin < text.size()) text[begin] = static_cast<char>(text[begin] ^ (1 << below(8)));
        break;
      case 6:  // one digit or letter for its neighbour
        if (begin < text.size()) text[begin] = static_cast<char>(text[begin] + (random_.chance(0.5) ? 1 : -1));
        break;
      default: {  // the front of this and the back of another
        const std::string& back = pick(seeds_);
        text = text.substr(0, begin) + back.substr(below(back.size() + 1));
      }
    }
    if (text.size() > 2 * longest_input) text.resize(longest_input);
  }

  std::vector<std::string> seeds_;
  std::vector<std::string> tokens_;
  folk::RandomStream random_;
};

/// Tries one input from memory of exactly its size, so that a sanitizer sees a read past its end.
void try_input(const std::string& input) {
  const auto bytes = std::make_unique<std::uint8_t[]>(input.size());
  std::copy(input.begin(), input.end(), bytes.get());
  LLVMFuzzerTestOneInput(bytes.get(), input.size());
}

int fuzz(int argc, char** argv) {
  const std::uint64_t inputs = argc > 1 ? std::stoull(argv[1]) : 100'000;
  const std::uint64_t seed = argc > 2 ? std::stoull(argv[2]) : 1;
  std::vector<std::string> seeds;
  for (int i = 3; i < argc; ++i) std::ranges::move(read_corpus(argv[i]), std::back_inserter(seeds));
  if (argc > 3 && seeds.empty()) {
    std::fputs("the corpus folder holds no file; add an input that the parser takes\n", stderr);
    return 2;
  }
  Mutator mutator(std::move(seeds), seed);
  for (current_number = 0; current_number < inputs; ++current_number) {
    current_input = mutator.input(current_number);
    try_input(current_input);
  }
  std::printf("%llu inputs, no crash\n", static_cast<unsigned long long>(inputs));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, on_signal);
  if (__sanitizer_set_death_callback != nullptr) __sanitizer_set_death_callback(print_input);
  try {
    return fuzz(argc, argv);
  } catch (const std::exception& error) {
    print_input();
    std::fprintf(stderr, "it threw what is no folk::Error: %s\n", error.what());
    return 1;
  }
}
