#include <folk/tools/mpe_train/offline.h>

#include <folk/tools/choices/checkpoint_option.h>
#include <folk/tools/program/interruption.h>
#include <folk/tools/program/output_file.h>
#include <folk/tools/program/progress.h>
#include <folk/tools/program/table.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>
#include <folk/games/criterion.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/games/utf8.h>
#include <folk/mpe/offline/learners.h>
#include <folk/mpe/offline/resumable_training.h>
#include <folk/mpe/players/policy_file.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <system_error>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using mpe::LearnerChoice;
using mpe::OfflineTraining;

constexpr const char* offline_name = "mpe-train offline";

Program offline_program() {
  Program program;
  program.name = offline_name;
  program.title = "trains predators from a data set alone";
  program.usage = "--learner LEARNER --data DIR --output FILE [options]";
  program.summary =
      "Trains predators of the particle world from a data set alone (mpe-train collect, or others' in that form):\n"
      "  bc      clones what the predators did after the last 20 steps that they saw\n"
      "  ma-bcq  batch-constrained Q-learning with a mixer of the predators' values\n"
      "  omar    conservative Q-learning whose actor imitates the best actions that a search finds; cql without it\n"
      "  madt    a decision transformer without beliefs\n"
      "  rmadt   with beliefs of the prey's actions that its own do not look at\n"
      "  sct     the self-confirming transformer: it acts on its beliefs\n"
      "The same data, settings and seed give the same file, for any number of threads.";
  program.examples = {
      "mpe-train offline --learner sct --data tag-expert --output sct.safetensors",
      "mpe-train offline --learner omar --data tag-medium --budget paper --output omar.safetensors",
      "mpe-train offline --learner sct --loss selfconf --readout token --data tag-expert --output sct.safetensors",
      "mpe-train offline --learner bc --data tag-expert --output bc.safetensors --checkpoint run-1 --resume",
      "mpe-evaluate --predators sct.safetensors --prey released,maddpg,still --beliefs"};
  auto add = program.options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("learner", text(), "bc, ma-bcq, omar, cql, madt, rmadt or sct");
  add("data", text(), "the folder of the data set");
  add("budget", text(), "small (minutes on a core, the default) or paper (what the sources say)");
  add("seed", text(), "of the first parameters and all that is drawn (default 1)");
  add("steps", text(), "gradient steps, instead of the budget's");
  add("level", text(),
      "random, medium-replay, medium or expert, where the data do not say it: omar's numbers are chosen by it");
  add("hidden", text(), "width of the network");
  add("layers", text(), "hidden layers, or blocks of a transformer");
  add("batch", text(), "examples of a step");
  add("learning-rate", text(), "highest learning rate");
  add("dropout", text(), "share of units that are dropped (bc and transformers)");
  add("loss", text(), "of sct: teacher (true actions stand for beliefs in training, default), selfconf or composite");
  add("readout", text(), "of sct, where actions are read: cat (default), add or token");
  add("conservatism", text(), "of omar and cql: alpha");
  add("imitation", text(), "of omar: c");
  add("output", text(), "the policy file (default predators.safetensors)");
  add("curve", text(), "file for the losses (default: the output's name with .csv)");
  add("threads", text(), "threads (default: one a processor); the results do not depend on it");
  add("checkpoint-every", text(), "steps between checkpoints (default 1000)");
  add_checkpoint_options(program.options);
  return program;
}

sct::Readout parse_readout(const std::string& text) {
  for (const auto readout : {sct::Readout::token, sct::Readout::cat, sct::Readout::add})
    if (text == to_string(readout)) return readout;
  throw UsageError(fmt::format("--readout '{}': expected cat, add or token", excerpt(text)));
}

LearnerChoice choice_of(const po::variables_map& values, const Common& common) {
  if (values.count("learner") == 0)
    throw UsageError("which learner? Give --learner bc, ma-bcq, omar, cql, madt, rmadt or sct");
  LearnerChoice choice;
  choice.kind = mpe::parse_learner(text_option(values, "learner"));
  choice.budget = mpe::parse_budget(text_option(values, "budget", "small"));
  choice.seed = whole_option(values, "seed", 1, 0, ~std::uint64_t{0});
  choice.threads = threads_option(values, common);
  if (values.count("level") != 0) {
    choice.level = text_option(values, "level");
    if (choice.level != "random" && choice.level != "medium-replay" && choice.level != "medium" &&
        choice.level != "expert")
      throw UsageError(
          fmt::format("--level '{}': expected random, medium-replay, medium or expert", excerpt(*choice.level)));
  }
  const auto whole = [&](const char* option, std::uint64_t most) { return whole_option(values, option, 1, 1, most); };
  if (values.count("steps") != 0) choice.steps = whole("steps", 1'000'000'000);
  if (values.count("hidden") != 0) choice.hidden = whole("hidden", 4096);
  if (values.count("layers") != 0) choice.layers = whole("layers", 16);
  if (values.count("batch") != 0) choice.batch = whole("batch", 65'536);
  const auto real = [&](const char* option, double least, double most) {
    return parse_number(text_option(values, option), fmt::format("--{}", option), least, most);
  };
  if (values.count("learning-rate") != 0) choice.learning_rate = real("learning-rate", 1e-9, 1);
  if (values.count("dropout") != 0) choice.dropout = real("dropout", 0, 0.9);
  if (values.count("conservatism") != 0) choice.conservatism = real("conservatism", 0, 1000);
  if (values.count("imitation") != 0) choice.imitation = real("imitation", 0, 1);
  if (values.count("loss") != 0) choice.loss = sct::parse_loss_mode(text_option(values, "loss"));
  if (values.count("readout") != 0) choice.readout = parse_readout(text_option(values, "readout"));
  return choice;
}

/// The library names a setting; to who types, it is an option.
template <class Work>
auto with_option_names(const Work& work) {
  try {
    return work();
  } catch (const UsageError& error) {
    const std::string message = error.what();
    const std::string name = message.substr(0, message.find_first_of(": "));
    for (const char* option :
         {"hidden", "layers", "batch", "learning-rate", "dropout", "loss", "readout", "conservatism", "imitation"})
      if (name == option) throw UsageError("--" + message);
    throw;
  }
}

/// Where a run's results go.
struct OfflineFiles {
  fs::path output, curve;
};

OfflineFiles files_of(const po::variables_map& values) {
  OfflineFiles files;
  files.output = text_option(values, "output", "predators.safetensors");
  if (files.output.empty()) throw UsageError("--output: name the file of the policy");
  files.curve = text_option(values, "curve", fs::path(files.output).replace_extension(".csv").string());
  if (files.curve.empty()) throw UsageError("--curve: name the file of the losses, or leave it out");
  require_writable(files.output, "--output");
  require_writable(files.curve, "--curve");
  // "a.csv", "./a.csv" and a link to it are one file; what is written to a device or a pipe stays apart.
  const auto place = [](const fs::path& file) { return fs::weakly_canonical(fs::absolute(file)); };
  if (std::error_code ignored; !fs::is_other(files.output, ignored) && place(files.output) == place(files.curve))
    throw UsageError(fmt::format("{}: two results would go to this file", excerpt(files.output.string(), 1000)));
  return files;
}

/// A network of the width that is asked for has at least these bytes.
std::size_t least_bytes(const LearnerChoice& choice) {
  const std::size_t layers = choice.layers.value_or(1);
  const std::size_t square = choice.hidden.value_or(1) * choice.hidden.value_or(1) * sizeof(float);
  switch (choice.kind) {
    case mpe::LearnerKind::madt:
    case mpe::LearnerKind::rmadt:
    case mpe::LearnerKind::sct: return 12 * square * layers;  // four squares of attention, eight of what follows it
    case mpe::LearnerKind::bc: return square * (layers - 1);
    case mpe::LearnerKind::ma_bcq:
    case mpe::LearnerKind::omar:
    case mpe::LearnerKind::cql: break;
  }
  return 3 * square;  // a network for each predator
}

/// Refuses to train what could not be played, as its file would be too large to be read.
void require_readable(std::size_t bytes) {
  if (bytes > mpe::largest_policy_file)
    throw UsageError(fmt::format("its policy would have {} MiB or more, of which {} are read; choose a smaller network",
                                 bytes >> 20U, mpe::largest_policy_file >> 20U));
}

void write_curve(std::ostream& out, const OfflineTraining& training) {
  out << "steps";
  for (const auto& loss : training.names()) out << ',' << loss;
  out << '\n';
  for (const auto& point : training.curve()) {
    out << point.steps;
    for (const double loss : point.losses) out << fmt::format(",{}", loss);
    out << '\n';
  }
}

void write_text(std::ostream& out, const OfflineTraining& training, const LearnerChoice& choice,
                const mpe::DataSet& data, const OfflineFiles& files) {
  out << fmt::format("{} on {} ({}, {} transitions), seed {}\n\n", to_string(choice.kind), excerpt(data.source(), 1000),
                     data.scenario().name, data.transitions(), choice.seed);
  std::vector<std::string> header{"steps"};
  header.insert(header.end(), training.names().begin(), training.names().end());
  Table table(header);
  const auto& curve = training.curve();
  const std::size_t every = std::max<std::size_t>(1, (curve.size() + 9) / 10);  // some ten rows
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if ((i + 1) % every != 0 && i + 1 != curve.size()) continue;
    std::vector<std::string> row{fmt::to_string(curve[i].steps)};
    for (const double loss : curve[i].losses) row.push_back(fmt::format("{:.5f}", loss));
    table.add(row);
  }
  out << table.text()
      << fmt::format("\npolicy in {}\nlosses in {}\n", visible_text(files.output.string()),
                     visible_text(files.curve.string()));
}

void write_json(std::ostream& out, const OfflineTraining& training, const std::map<std::string, std::string>& notes,
                const OfflineFiles& files) {
  Json json{{"notes", notes}, {"steps", training.steps()}, {"losses", Json::array()}};
  for (const auto& point : training.curve()) {
    Json row{{"steps", point.steps}};
    for (std::size_t i = 0; i < point.losses.size(); ++i) row[training.names()[i]] = point.losses[i];
    json["losses"].push_back(row);
  }
  json["files"] = {{"output", files.output.string()}, {"curve", files.curve.string()}};
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void train(OfflineTraining& training, const mpe::TrainingWatch& rules, const Common& common) {
  mpe::TrainingWatch watch = rules;
  watch.note = [&](const std::string& fault) { common.note(fmt::format("note: {}; the one before is taken", fault)); };
  if (mpe::resume(training, watch)) common.note(fmt::format("resumed at step {}", training.steps()));
  const Interruption interruption;
  ProgressBar bar("training", !common.quiet);
  try {
    mpe::train(training, watch, {std::ref(bar), Interruption::requested});
  } catch (const Cancelled&) {
    throw EnvironmentError(
        watch.folder == nullptr
            ? fmt::format("interrupted after step {}; nothing is kept without --checkpoint DIR", training.steps())
            : fmt::format("interrupted after step {}; the same command with --resume goes on from there",
                          training.steps()));
  }
}

int offline(const po::variables_map& values, const Common& common) {
  const auto choice = choice_of(values, common);
  if (text_option(values, "data").empty())
    throw UsageError("from which data? Give --data DIR; mpe-train collect makes one");
  const auto files = files_of(values);
  const auto checkpoint_every = whole_option(values, "checkpoint-every", 1000, 1, 1'000'000'000);
  mpe::DataSetRules rules;
  rules.threads = choice.threads;
  const auto data = mpe::DataSet::open(text_option(values, "data"), rules);
  require_readable(least_bytes(choice));  // before it takes the memory
  auto learner = with_option_names([&] { return mpe::make_learner(data, choice); });
  require_readable(learner->policy({}).size());
  const auto description = mpe::run_description(data, choice, *learner);
  OfflineTraining training(std::move(learner), description, mpe::learner_steps(data, choice));
  const auto folder = checkpoint_folder<sct::CheckpointFiles>(values, common);
  mpe::TrainingWatch watch;
  watch.folder = folder.get();
  watch.checkpoint_every = checkpoint_every;
  train(training, watch, common);

  const std::map<std::string, std::string> notes{{"training", description},
                                                 {"learner", std::string(to_string(choice.kind))},
                                                 {"budget", std::string(to_string(choice.budget))},
                                                 {"steps", fmt::to_string(training.steps())},
                                                 {"folk", FOLK_VERSION}};
  write_file(files.output, training.learner().policy(notes));
  write_file(files.curve, [&](std::ostream& out) { write_curve(out, training); });
  switch (common.format) {
    case Format::csv: write_curve(std::cout, training); break;
    case Format::json: write_json(std::cout, training, notes, files); break;
    default: write_text(std::cout, training, choice, data, files);
  }
  return done;
}

}  // namespace

int mpe_offline(int argc, char** argv) { return run(argc, argv, offline_program(), {"text", "csv", "json"}, offline); }

}  // namespace folk::tools
