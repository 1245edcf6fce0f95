#pragma once
// Work in pieces that one process does, or several that a launcher started together: the result is the same.

#include <folk/games/progress.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace folk {

/// Work that is cut in pieces, each of which leaves its result at a place of its own in the memory of whoever did it.
/// How it is cut depends on the work alone, so that who does which piece changes no result.
struct SharedWork {
  std::function<std::uint64_t()> identity;  ///< a signature of all that the results depend on
  std::size_t pieces = 0;
  unsigned threads = 1;  ///< of this process that do pieces

  /// Does a piece; called once for each piece that this process does, from any thread. `worker` (below `threads`) tells
  /// whose scratch space to use.
  std::function<void(std::size_t piece, unsigned worker)> work;
  /// What `work` left at the place of a piece, as bytes (packing.h); called by the thread that did it, or later.
  std::function<std::string(std::size_t piece)> pack;
  /// Puts at its place what another process, or an earlier run, left of a piece; called while others are worked at.
  std::function<void(std::size_t piece, std::string_view bytes)> unpack;
};

/// Where finished pieces are kept, so that another run need not do them again.
class PieceStore {
public:
  virtual ~PieceStore() = default;

  /// Work begins. Throws InputFileError where what is kept belongs to something else.
  virtual void begin(std::uint64_t identity, std::size_t pieces) = 0;
  /// What an earlier run left of a piece.
  virtual std::optional<std::string> find(std::size_t piece) = 0;
  /// A piece is done. One thread at a time.
  virtual void keep(std::size_t piece, std::string_view bytes) = 0;
};

/// Who does the work.
class Crew {
public:
  virtual ~Crew() = default;

  /// How many processes there are, and which of them this is. Rank 0 is the one that speaks and writes.
  virtual std::size_t ranks() const = 0;
  virtual std::size_t rank() const = 0;
  bool first() const { return rank() == 0; }

  /// Does all pieces; every rank calls it with the same work. Afterwards all results are at their places on every rank.
  /// `progress` of rank 0 is told the finished share. When pieces throw, what the earliest of them threw is thrown on
  /// every rank; so is Cancelled where rank 0 or another is told to end.
  virtual void run(const SharedWork& work, const Progress& progress = nullptr) const = 0;

  /// What rank 0 gives, on every rank; every rank calls it.
  virtual std::string tell(std::string bytes) const = 0;

  /// From now on rank 0 takes pieces from `store` and puts them there; null: it does not.
  void keep_in(PieceStore* store) { store_ = store; }

protected:
  PieceStore* store() const { return store_; }

private:
  PieceStore* store_ = nullptr;
};

/// This process alone.
class OneProcess : public Crew {
public:
  std::size_t ranks() const override { return 1; }
  std::size_t rank() const override { return 0; }
  void run(const SharedWork& work, const Progress& progress = nullptr) const override;
  std::string tell(std::string bytes) const override { return bytes; }
};

/// The crew of whoever names none: this process, and nothing is kept.
const Crew& one_process();

}  // namespace folk
