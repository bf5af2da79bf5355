#pragma once
/// Work of a device as plain data: what Device::record notes, and what can be done again elsewhere.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "base/aligned_vector.h"
#include "device/device.h"

namespace triad {

struct Recording {
    /// Shared by all that have the same bytes; never changed.
    using Content = std::shared_ptr<const AlignedVector<std::byte>>;

    struct Source {
        std::string path;  ///< in kernels/
        std::string text;  ///< flattened
        Options options;
    };
    struct Function {
        std::size_t source = 0;
        std::string name;
    };
    struct Memory {
        std::uint64_t bytes = 0;
        bool read_only = false;  ///< of kernels
        Content content;         ///< at the beginning; null: it is written before it is read
    };

    /// Bytes of `memory` from `offset` on.
    struct Write {
        std::size_t memory = 0;
        std::uint64_t offset = 0;
        Content content;
    };
    struct FillZero {
        std::size_t memory = 0;
    };
    struct NoMemory {};
    /// A place in `memories`, a null pointer, or the bytes of a value.
    using Argument = std::variant<std::size_t, NoMemory, std::string>;
    struct Launch {
        std::size_t function = 0;
        std::size_t arguments = 0;  ///< place in argument_lists
        std::uint64_t items = 0;
        std::uint64_t local = 0;  ///< as in Device::run
    };
    using Command = std::variant<Write, FillZero, Launch>;

    std::vector<Source> sources;
    std::vector<Function> functions;
    std::vector<Memory> memories;
    std::vector<std::vector<Argument>> argument_lists;  ///< each once
    std::vector<Command> commands;                      ///< in their order
};

}  // namespace triad
