#pragma once

#include <cstdint>
#include <vector>

#include "solver/contact/plate_friction.h"
#include "solver/load/load_stepping.h"
#include "solver/newton/model.h"
#include "solver/press/compression_result.h"

namespace mammotwin {

/// All that the load steps so far leave to the next one. A compression of the same problem with the
/// same options that starts from it ends as the one that left it would have, bit for bit.
struct CompressionCheckpoint {
  struct GoodStep {
    double fraction = 0;  ///< of the way
    State state;
  };
  std::vector<HermiteMesh::Node> found;  ///< before the plates closed
  LoadSteppingReport load;
  GoodStep before, reached;  ///< the last two good steps
  double tilt = 0;           ///< of the paddle [deg]
  double penalty = 0;        ///< [kPa/mm]; 0: none yet
  PlateFriction::History sticking;
  CompressionReport report;  ///< history and counts
};

/// As bytes (CBOR, every double as it is). `run` says what the compression is of; any text.
std::vector<std::uint8_t> encode_checkpoint(const CompressionCheckpoint& checkpoint,
                                            const std::string& run);

/// Throws std::runtime_error if the bytes are damaged or speak of another run.
CompressionCheckpoint decode_checkpoint(const std::vector<std::uint8_t>& bytes,
                                        const std::string& run);

}  // namespace mammotwin
