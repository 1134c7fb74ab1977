// The loading thread: reads and decodes what the player is about to need.
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "play/ready_cell.h"

namespace viewcell {

/// A cell's geometry or a centre's textures.
using LoadKey = std::variant<CellId, CentreId>;

struct Loaded {
  LoadKey key;
  std::shared_ptr<const ReadyCell> cell;  ///< of a CellId; null: see fault
  CentreTextures textures;                ///< of a CentreId; none: see fault
  std::string fault = {};                 ///< why the file could not be read; empty: it could
};

/// Reads what it is asked for, in the order asked. Makes no GL calls. All functions are called from
/// the drawing thread; the loading thread is private.
class Loader {
 public:
  /// The bundle must outlive this.
  explicit Loader(const Bundle& bundle);
  ~Loader();
  Loader(const Loader&) = delete;
  Loader& operator=(const Loader&) = delete;

  /// Replaces what is still waiting by these, most urgent first. What is being read goes on.
  void request(const std::vector<LoadKey>& keys);
  /// What has been read since the last call, first read first. A file at fault (InputError) is a
  /// Loaded that says so; anything else that reading threw is rethrown.
  std::vector<Loaded> collect();
  /// Reads one at once, on the calling thread.
  Loaded read(const LoadKey& key);
  /// Takes back the memory of texels that are in GL memory now; the next centre is read into it.
  void recycle(std::vector<Rgba8> texels);

 private:
  void work();
  std::vector<Rgba8> take_spare();

  const Bundle& bundle_;
  std::mutex mutex_;  // guards all below
  std::condition_variable wake_;
  std::deque<LoadKey> waiting_;
  std::vector<Loaded> done_;
  std::vector<std::vector<Rgba8>> spare_;
  std::exception_ptr failure_;
  bool is_stopping_ = false;
  std::thread thread_;  // last: it starts when all else is made
};

}  // namespace viewcell
