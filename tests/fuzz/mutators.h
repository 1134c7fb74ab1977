// Changes of inputs that keep their frame: most that is changed blindly is refused by it, and what
// lies behind is not reached. All: in place, n_bytes of `data`, which has room for `most`; the new
// length; 0: the input has no such frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>

namespace viewcell {

using FuzzRandom = std::minstd_rand;

/// Below n, which is above 0.
inline std::size_t pick(FuzzRandom& random, std::size_t n) {
  return random() % n;
}

/// libFuzzer's own changes; room: bytes that may be added.
void mutate_bytes(std::string& bytes, std::size_t room);

/// A number of a packed array: a special one, a neighbour's, or one more or less.
void mutate_numbers(std::string& bytes, FuzzRandom& random);

/// One section's numbers or bytes; the table is put right.
std::size_t mutate_sections(std::uint8_t* data, std::size_t n_bytes, std::size_t most,
                            FuzzRandom& random);

/// One value of a JSON text.
std::size_t mutate_json(std::uint8_t* data, std::size_t n_bytes, std::size_t most,
                        FuzzRandom& random);

/// The JSON or the numbers of a GLB; the lengths are put right.
std::size_t mutate_glb(std::uint8_t* data, std::size_t n_bytes, std::size_t most,
                       FuzzRandom& random);

}  // namespace viewcell

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t n_bytes, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t n_bytes,
                                               std::size_t most, unsigned seed);

/// Defines libFuzzer's hook: now and then a blind change, else one of these.
#define VIEWCELL_FUZZ_MUTATOR(mutate)                                                            \
  std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t n_bytes, std::size_t most, \
                                      unsigned seed) {                                           \
    viewcell::FuzzRandom random(seed);                                                           \
    constexpr std::size_t kBlindOneOf = 6;                                                       \
    const bool is_blind = viewcell::pick(random, kBlindOneOf) == 0;                              \
    const std::size_t n = is_blind ? 0 : viewcell::mutate(data, n_bytes, most, random);          \
    return n > 0 ? n : LLVMFuzzerMutate(data, n_bytes, most);                                    \
  }
