#include "play/loader.h"

#include "base/error.h"

namespace viewcell {
namespace {

// As many centres as a new cell needs, about.
constexpr std::size_t kMostSpare = 4;

}  // namespace

Loader::Loader(const Bundle& bundle) : bundle_(bundle), thread_([this] { work(); }) {}

Loader::~Loader() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Loader::request(const std::vector<LoadKey>& keys) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.assign(keys.begin(), keys.end());
  }
  wake_.notify_one();
}

std::vector<Loaded> Loader::collect() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
  return std::exchange(done_, {});
}

void Loader::recycle(std::vector<Rgba8> texels) {
  const std::lock_guard lock(mutex_);
  if (spare_.size() < kMostSpare) spare_.push_back(std::move(texels));
}

std::vector<Rgba8> Loader::take_spare() {
  const std::lock_guard lock(mutex_);
  if (spare_.empty()) return {};
  std::vector<Rgba8> out = std::move(spare_.back());
  spare_.pop_back();
  return out;
}

Loaded Loader::read(const LoadKey& key) {
  Loaded out{key, nullptr, {}};
  try {
    if (const auto* cell = std::get_if<CellId>(&key))
      out.cell = std::make_shared<ReadyCell>(
          make_ready_cell(bundle_.scene(), bundle_.cells(), *cell, bundle_.read_cell(*cell)));
    else
      out.textures = bundle_.read_centre(std::get<CentreId>(key), take_spare());
  } catch (const InputError& error) {
    out.fault = error.what();
  }
  return out;
}

void Loader::work() {
  for (;;) {
    LoadKey key;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return is_stopping_ || (!waiting_.empty() && !failure_); });
      if (is_stopping_) return;
      key = waiting_.front();
      waiting_.pop_front();
    }
    try {
      Loaded loaded = read(key);
      const std::lock_guard lock(mutex_);
      done_.push_back(std::move(loaded));
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
    }
  }
}

}  // namespace viewcell
