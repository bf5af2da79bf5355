#include "device/recorder.h"

#include <cstring>

#include "base/memory_limit.h"

namespace triad {
namespace opencl {
namespace {

/// Of a property of a buffer; 0 where the driver does not say.
template <class T>
T property(cl_mem memory, cl_mem_info what) {
    T value{};
    return clGetMemObjectInfo(memory, what, sizeof value, &value, nullptr) == CL_SUCCESS ? value : T{};
}

/// Equal lists have equal texts.
std::string text_of(const std::vector<Recording::Argument>& arguments) {
    std::string text;
    for (const Recording::Argument& argument : arguments) {
        if (const auto* place = std::get_if<std::size_t>(&argument))
            text += "m" + std::to_string(*place);
        else if (const auto* bytes = std::get_if<std::string>(&argument))
            text += "b" + std::to_string(bytes->size()) + ":" + *bytes;
        else
            text += "n";
    }
    return text;
}

}  // namespace

std::size_t Recorder::place_of(const Handle& handle, bool overwritten) {
    const auto [found, is_new] = memories_.try_emplace(handle.get(), to_.memories.size());
    if (!is_new) return found->second;
    kept_.push_back(handle);
    const auto memory = static_cast<cl_mem>(handle.get());
    Recording::Memory& noted = to_.memories.emplace_back();
    noted.bytes = property<std::size_t>(memory, CL_MEM_SIZE);
    noted.read_only = property<cl_mem_flags>(memory, CL_MEM_FLAGS) & CL_MEM_READ_ONLY;
    if (overwritten) return found->second;
    require_memory(noted.bytes, "What a buffer of the device holds, which is to be captured,");
    AlignedVector<std::byte> content(noted.bytes);
    state_.core->check("clEnqueueReadBuffer",
                       clEnqueueReadBuffer(state_.commands(), memory, CL_TRUE, 0, content.size(),
                                           content.data(), 0, nullptr, nullptr));
    noted.content = std::make_shared<const AlignedVector<std::byte>>(std::move(content));
    return found->second;
}

std::optional<std::size_t> Recorder::known_place_of(const Handle& memory) const {
    const auto found = memories_.find(memory.get());
    return found == memories_.end() ? std::nullopt : std::optional(found->second);
}

void Recorder::write(const Handle& memory, const void* data, std::size_t bytes, std::size_t offset) {
    const bool whole =
        offset == 0 && bytes == property<std::size_t>(static_cast<cl_mem>(memory.get()), CL_MEM_SIZE);
    const std::size_t place = place_of(memory, whole);
    AlignedVector<std::byte> content(bytes);
    std::memcpy(content.data(), data, bytes);
    to_.commands.push_back(Recording::Write{
        place, offset, std::make_shared<const AlignedVector<std::byte>>(std::move(content))});
}

void Recorder::fill_zero(const Handle& memory) {
    to_.commands.push_back(Recording::FillZero{place_of(memory, true)});
}

Recording::Argument Recorder::argument(const Handle& memory) {
    if (!memory) return Recording::NoMemory{};
    return place_of(memory);
}

Recording::Argument Recorder::argument(const std::vector<std::byte>& value) {
    return std::string(reinterpret_cast<const char*>(value.data()), value.size());
}

std::size_t Recorder::function_of(const KernelState& kernel) {
    const ProgramState& program = *kernel.program;
    const auto [source, new_source] = sources_.try_emplace(&program, to_.sources.size());
    if (new_source) to_.sources.push_back({program.path, program.text, program.definitions});
    const auto [function, new_function] =
        functions_.try_emplace({source->second, kernel.where.kernel}, to_.functions.size());
    if (new_function) to_.functions.push_back({source->second, kernel.where.kernel});
    return function->second;
}

void Recorder::launch(const KernelState& kernel, const std::vector<Recording::Argument>& arguments,
                      std::size_t items, std::size_t local) {
    const auto [list, is_new] = argument_lists_.try_emplace(text_of(arguments), to_.argument_lists.size());
    if (is_new) to_.argument_lists.push_back(arguments);
    to_.commands.push_back(Recording::Launch{function_of(kernel), list->second, items, local});
}

}  // namespace opencl

void Device::record(Recording* recording) {
    state_->recorder = recording ? std::make_unique<opencl::Recorder>(*state_, *recording) : nullptr;
}

std::optional<std::size_t> Device::recorded(const Buffer& buffer) const {
    return state_->recorder ? state_->recorder->known_place_of(buffer.handle_) : std::nullopt;
}

}  // namespace triad
