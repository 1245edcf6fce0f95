#pragma once
// A data set of the particle world as text and JSON: what mpe-train collect has written and mpe-train inspect has read.

#include <folk/mpe/data/data_set.h>

#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace folk::tools {

struct DataReport {
  struct File {
    std::string name;
    std::vector<std::size_t> shape;
    sct::NpyType type = sct::NpyType::float32;
  };

  std::string folder;
  mpe::Scenario scenario;
  std::size_t transitions = 0;
  std::vector<File> files;
  mpe::DataFigures figures;
  std::optional<mpe::DataDescription> description;  ///< nothing where the data set does not say how it was made
};

/// Of a data set that was read.
DataReport data_report(const mpe::DataSet& data, const mpe::DataFigures& figures);

/// Of one that was written.
DataReport data_report(const std::string& folder, const mpe::Scenario& scenario, const mpe::DataRecord& record);

void write_text(std::ostream& out, const DataReport& report);

/// One object; docs/mpe-data.md says what it holds.
void write_json(std::ostream& out, const DataReport& report);

}  // namespace folk::tools
