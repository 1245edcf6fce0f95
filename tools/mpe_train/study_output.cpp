#include <folk/tools/mpe_train/study_output.h>

#include <folk/tools/mpe_train/study_page.h>

#include <fmt/format.h>
#include <folk/analysis/pictures/render.h>
#include <folk/games/error.h>
#include <folk/games/text_file.h>
#include <folk/mpe/study/study_csv.h>
#include <folk/mpe/study/study_latex.h>
#include <folk/mpe/study/study_pictures.h>

#include <system_error>
#include <vector>

namespace folk::tools {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder, error))
    throw EnvironmentError(fmt::format("{}: no folder of that name can be made", excerpt(folder.string(), 1000)));
}

void write_all(const fs::path& folder, const std::vector<mpe::NamedText>& files) {
  for (const auto& file : files) write_file(folder / file.name, file.text);
}

/// Draws all that there is to draw; pictures of which nothing was run, or that cannot be drawn, are removed, as they
/// would be of other tables.
DrawnPictures draw_all(const fs::path& folder, const std::vector<const mpe::StudyTables*>& all) {
  DrawnPictures drawn;
  for (const auto* tables : all) {
    for (const auto& name : mpe::study_picture_names(*tables)) {
      std::error_code ignored;
      fs::remove(folder / (name + ".svg"), ignored);
    }
    for (const auto& picture : mpe::study_pictures(*tables)) {
      if (!drawn.missing.empty()) break;
      const fs::path file = folder / (picture.name + ".svg");
      try {
        draw(picture, file);
        drawn.svgs[picture.name] = read_text_file(file);
      } catch (const RendererMissing& missing) {
        drawn.missing = missing.what();
      }
    }
  }
  return drawn;
}

}  // namespace

void write_study_files(const fs::path& folder, const mpe::StudyTables& main, const mpe::StudyTables& second,
                       const mpe::StudySettings& settings) {
  for (const auto& one : {folder, folder / "latex", folder / "pictures"}) make_folder(one);
  write_all(folder, mpe::study_csv_files(main));
  write_all(folder, mpe::study_csv_files(second));
  write_all(folder / "latex", mpe::study_latex_files(main, second));
  write_file(folder / "study.txt", study_text(main, second));
  const auto pictures = draw_all(folder / "pictures", {&main, &second});
  write_file(folder / "study.html", study_page(main, second, settings, pictures));
}

}  // namespace folk::tools
