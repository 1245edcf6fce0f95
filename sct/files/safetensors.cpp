#include <folk/games/error.h>
#include <folk/sct/files/little_endian.h>
#include <folk/sct/files/safetensors.h>

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace folk::sct {

namespace {

constexpr std::size_t length_bytes = 8;
constexpr std::size_t most_tensor_dimensions = 8;
constexpr const char* metadata_name = "__metadata__";

/// One entry of the header while it is read.
struct Entry {
  std::optional<std::string> dtype;
  std::optional<std::vector<std::uint64_t>> shape;
  std::optional<std::vector<std::uint64_t>> offsets;
};

/// Takes the events of nlohmann's JSON parser, so that a header of any depth, size or doubled name is refused at the
/// byte where it goes wrong, and nothing is built but what the format allows.
class HeaderReader : public nlohmann::json_sax<nlohmann::json> {
public:
  explicit HeaderReader(const std::string& source)
      : source_(source) {}

  std::map<std::string, std::string> metadata;
  std::map<std::string, Entry> tensors;

  bool start_object(std::size_t) override {
    if (depth_ > 1) unexpected("an object");
    return ++depth_, true;
  }

  bool key(std::string& text) override {
    if (depth_ == 1) {
      name_ = text;
      if (name_.empty()) refuse_header("a tensor without a name");
      bool fresh = false;
      if (name_ == metadata_name) {
        fresh = !std::exchange(metadata_seen_, true);
        entry_ = nullptr;
      } else {
        const auto [place, added] = tensors.try_emplace(name_);
        fresh = added;
        entry_ = &place->second;
      }
      if (!fresh) refuse_header(fmt::format("'{}' is there twice", excerpt(name_)));
    } else {
      field_ = text;
      if (entry_ == nullptr && metadata.contains(field_))
        refuse_header(fmt::format("metadata '{}' is there twice", excerpt(field_)));
      if (entry_ != nullptr) check_field();
    }
    return true;
  }

  bool end_object() override { return --depth_, true; }

  bool start_array(std::size_t) override {
    if (depth_ != 2 || entry_ == nullptr || field_ == "dtype") unexpected("a list");
    array_ = &(field_ == "shape" ? entry_->shape : entry_->offsets).emplace();
    return ++depth_, true;
  }

  bool end_array() override {
    array_ = nullptr;
    return --depth_, true;
  }

  bool string(std::string& text) override {
    if (depth_ != 2 || (entry_ != nullptr && field_ != "dtype")) unexpected("a text");
    if (entry_ != nullptr)
      entry_->dtype = text;
    else
      metadata[field_] = text;
    return true;
  }

  bool number_unsigned(std::uint64_t number) override {
    if (array_ == nullptr) unexpected("a number");
    if (array_->size() == most_tensor_dimensions)
      refuse_header(
          fmt::format("tensor '{}': {} has more than {} numbers", excerpt(name_), field_, most_tensor_dimensions));
    array_->push_back(number);
    return true;
  }

  bool null() override { unexpected("null"); }
  bool boolean(bool) override { unexpected("a truth value"); }
  bool number_integer(std::int64_t) override { unexpected("a negative number"); }
  bool number_float(double, const std::string&) override { unexpected("a number that is not whole or too large"); }
  bool binary(nlohmann::json::binary_t&) override { unexpected("binary data"); }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception&) override {
    refuse_header(fmt::format("no JSON at its byte {}", position));
  }

private:
  [[noreturn]] void refuse_header(const std::string& what) const {
    refuse_file(source_, fmt::format("damaged header: {}; take a fresh copy of the file", what));
  }

  [[noreturn]] void unexpected(const char* what) const {
    if (depth_ == 0) refuse_header(fmt::format("{} instead of an object", what));
    if (depth_ == 1) refuse_header(fmt::format("'{}' is {} instead of an object", excerpt(name_), what));
    refuse_header(fmt::format("'{}' of '{}' holds {}", excerpt(field_), excerpt(name_), what));
  }

  void check_field() const {
    const bool known = field_ == "dtype" || field_ == "shape" || field_ == "data_offsets";
    if (!known) refuse_header(fmt::format("tensor '{}' has an unknown '{}'", excerpt(name_), excerpt(field_)));
    const bool twice = field_ == "dtype"   ? entry_->dtype.has_value()
                       : field_ == "shape" ? entry_->shape.has_value()
                                           : entry_->offsets.has_value();
    if (twice) refuse_header(fmt::format("tensor '{}' has '{}' twice", excerpt(name_), field_));
  }

  const std::string& source_;
  std::size_t depth_ = 0;
  std::string name_;        ///< of the entry at depth 1
  std::string field_;       ///< of the entry at depth 2
  Entry* entry_ = nullptr;  ///< none in the metadata
  std::vector<std::uint64_t>* array_ = nullptr;
  bool metadata_seen_ = false;
};

/// The JSON between the length and the data.
std::string_view header_text(std::string_view bytes, const std::string& source) {
  constexpr const char* foreign = "no safetensors file";
  if (bytes.empty()) refuse_file(source, "an empty file; take a fresh copy");
  if (bytes.size() <= length_bytes)
    refuse_file(source, fmt::format("{}: only {} bytes; check the name", foreign, bytes.size()));
  if (bytes[length_bytes] != '{') refuse_file(source, fmt::format("{}: no JSON header; check the name", foreign));
  const auto length = load_little_endian<std::uint64_t>(bytes);
  if (length > longest_safetensors_header)
    refuse_file(source, fmt::format("no policy: a header of {} bytes, beyond {} MiB; check the name", length,
                                    longest_safetensors_header >> 20U));
  if (length > bytes.size() - length_bytes)
    refuse_file(source, fmt::format("ends within its header of {} bytes; take a fresh copy of the file", length));
  const auto text = bytes.substr(length_bytes, static_cast<std::size_t>(length));
  // The JSON parser takes it for the end.
  if (const auto zero = text.find('\0'); zero != std::string_view::npos)
    refuse_file(source, fmt::format("damaged header: a zero at its byte {}; take a fresh copy of the file", zero + 1));
  return text;
}

/// The tensor's own bytes.
std::string_view slice(std::string_view data, const std::string& name, const Entry& entry, const std::string& source) {
  const auto damaged = [&](const std::string& what) {
    refuse_file(source,
                fmt::format("damaged header: tensor '{}' {}; take a fresh copy of the file", excerpt(name), what));
  };
  if (!entry.dtype) damaged("has no dtype");
  if (!entry.shape) damaged("has no shape");
  if (!entry.offsets || entry.offsets->size() != 2) damaged("lacks its two data_offsets");
  const std::uint64_t begin = (*entry.offsets)[0];
  const std::uint64_t end = (*entry.offsets)[1];
  if (begin > end) damaged(fmt::format("ends at {}, before its begin at {}", end, begin));
  if (end > data.size())
    refuse_file(source,
                fmt::format("truncated: tensor '{}' ends at byte {} of the data, which has {}; take a fresh copy",
                            excerpt(name), end, data.size()));
  return data.substr(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
}

/// Every byte of the data belongs to one tensor.
void check_cover(const SafetensorsFile& file, std::string_view data, const std::string& source) {
  std::vector<std::pair<std::string_view, const std::string*>> parts;
  for (const auto& [name, tensor] : file.tensors) parts.emplace_back(tensor.data, &name);
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first.data(), a.first.size()) < std::pair(b.first.data(), b.first.size());
  });
  const char* reached = data.data();
  for (const auto& [part, name] : parts) {
    if (part.data() != reached)
      refuse_file(source,
                  fmt::format("damaged header: tensor '{}' begins at byte {} of the data, {} {}; take a fresh copy",
                              excerpt(*name), part.data() - data.data(),
                              part.data() < reached ? "inside another, which ends at" : "but the one before ends at",
                              reached - data.data()));
    reached += part.size();
  }
  const auto left = data.size() - static_cast<std::size_t>(reached - data.data());
  if (left > 0) refuse_file(source, fmt::format("{} bytes too many at its end; take a fresh copy of the file", left));
}

}  // namespace

SafetensorsFile parse_safetensors(std::string_view bytes, const std::string& source) {
  const std::string_view text = header_text(bytes, source);
  HeaderReader header(source);
  nlohmann::json::sax_parse(text.begin(), text.end(), &header);
  const std::string_view data = bytes.substr(length_bytes + text.size());
  SafetensorsFile file;
  file.metadata = std::move(header.metadata);
  for (auto& [name, entry] : header.tensors) {
    const std::string_view part = slice(data, name, entry, source);
    file.tensors.emplace(name, StoredTensor{std::move(*entry.dtype), std::move(*entry.shape), part});
  }
  check_cover(file, data, source);
  return file;
}

std::string safetensors_header(const std::map<std::string, std::string>& metadata,
                               const std::vector<TensorToStore>& tensors) {
  nlohmann::ordered_json header;
  header[metadata_name] = nlohmann::ordered_json(metadata);
  std::size_t begin = 0;
  for (const TensorToStore& tensor : tensors) {
    auto& entry = header[tensor.name];  // in this order for a human reader
    entry["dtype"] = "F32";
    entry["shape"] = tensor.shape;
    entry["data_offsets"] = {begin, begin + tensor.bytes};
    begin += tensor.bytes;
  }
  // Names of files stand in the texts, and these need be no UTF-8.
  std::string text = header.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  text.append((8 - text.size() % 8) % 8, ' ');
  if (text.size() > longest_safetensors_header)
    throw UsageError(fmt::format("a header of {} bytes, beyond {} MiB; shorten the texts, the roster above all",
                                 text.size(), longest_safetensors_header >> 20U));
  std::string bytes;
  append_little_endian(bytes, std::uint64_t{text.size()});
  return bytes + text;
}

}  // namespace folk::sct
