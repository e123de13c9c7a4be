"""A GPU's compiler without the GPU: Mesa's RADV on its null device.

It generates the machine code that the driver would run on an AMD GPU, and reports its length and resources. It draws
nothing.
"""

import os
import struct
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from unittest.mock import patch

FAMILY = "NAVI23"
"""RDNA 2 as in a Radeon RX 6600, a mid-range desktop GPU."""
OUTPUTS = 4
"""Most outputs of a program: those without an attachment would be left out, with all that they take."""
_ICD_FOLDERS = ("/usr/share/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/etc/vulkan/icd.d")
_EXTENSION = "VK_KHR_pipeline_executable_properties"
_STAGES = {"Vertex Shader": "vertex", "Fragment Shader": "fragment"}

_DECORATE, _TYPE_SAMPLED_IMAGE, _TYPE_STRUCT, _TYPE_POINTER, _VARIABLE = 71, 27, 30, 32, 59
_BINDING = 33
_HEADER_WORDS = 5


@dataclass(frozen=True)
class Figures:
    """Figures of a shader's machine code. ``waves``: maximum resident on a SIMD; ``spills``: registers spilled to
    memory."""

    instructions: int
    vgprs: int
    waves: int
    spills: int
    bytes: int


class CompilerError(RuntimeError):
    """The driver is missing, or rejects a program."""


def icd() -> Path | None:
    """The file by which Vulkan's loader finds RADV, if it is installed."""
    files = (path for folder in _ICD_FOLDERS for path in sorted(Path(folder).glob("radeon_icd*.json")))
    return next(files, None)


class Radv:
    """The null device. ``driver``: its name and version."""

    def __init__(self, vulkan: Any) -> None:
        self._vk = vk = vulkan
        # Structures keep names until their call returns: the binding frees those referenced only by another one.
        app = vk.VkApplicationInfo(
            pApplicationName="seafoam bench",
            applicationVersion=1,
            pEngineName="seafoam",
            engineVersion=1,
            apiVersion=vk.VK_MAKE_VERSION(1, 3, 0),
        )
        instance_info = vk.VkInstanceCreateInfo(pApplicationInfo=app)
        self._instance = vk.vkCreateInstance(instance_info, None)
        physical = vk.vkEnumeratePhysicalDevices(self._instance)[0]
        about = vk.vkGetPhysicalDeviceProperties(physical)
        version = about.driverVersion
        self.driver = f"{about.deviceName}, Mesa {version >> 22}.{version >> 12 & 0x3FF}.{version & 0xFFF}"
        if FAMILY not in self.driver:
            raise CompilerError(f"asked for RADV's {FAMILY}, got {self.driver}")
        rendering = vk.VkPhysicalDeviceDynamicRenderingFeatures(dynamicRendering=1)
        executable = vk.VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR(
            pNext=rendering, pipelineExecutableInfo=1
        )
        queue = vk.VkDeviceQueueCreateInfo(queueFamilyIndex=0, pQueuePriorities=[1.0])
        device_info = vk.VkDeviceCreateInfo(
            pNext=executable, pQueueCreateInfos=[queue], ppEnabledExtensionNames=[_EXTENSION]
        )
        self._device = vk.vkCreateDevice(physical, device_info, None)
        self._properties = vk.vkGetDeviceProcAddr(self._device, "vkGetPipelineExecutablePropertiesKHR")
        self._statistics = vk.vkGetDeviceProcAddr(self._device, "vkGetPipelineExecutableStatisticsKHR")

    def close(self) -> None:
        """Release all resources."""
        self._vk.vkDestroyDevice(self._device, None)
        self._vk.vkDestroyInstance(self._instance, None)

    def compile(self, vertex: bytes, fragment: bytes) -> dict[str, Figures]:
        """Figures of both stages, ``vertex`` and ``fragment``, of a pipeline of two SPIR-V modules."""
        vk = self._vk
        bindings = reflect(vertex) | reflect(fragment)
        kinds = {"block": vk.VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, "texture": vk.VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER}
        both = vk.VK_SHADER_STAGE_VERTEX_BIT | vk.VK_SHADER_STAGE_FRAGMENT_BIT
        entries = [
            vk.VkDescriptorSetLayoutBinding(
                binding=binding, descriptorType=kinds[kind], descriptorCount=1, stageFlags=both
            )
            for binding, kind in sorted(bindings.items())
        ]
        set_info = vk.VkDescriptorSetLayoutCreateInfo(pBindings=entries)
        set_layout = vk.vkCreateDescriptorSetLayout(self._device, set_info, None)
        layout_info = vk.VkPipelineLayoutCreateInfo(pSetLayouts=[set_layout])
        layout = vk.vkCreatePipelineLayout(self._device, layout_info, None)
        module_infos = [vk.VkShaderModuleCreateInfo(codeSize=len(code), pCode=code) for code in (vertex, fragment)]
        modules = [vk.vkCreateShaderModule(self._device, info, None) for info in module_infos]
        try:
            pipeline = self._pipeline(modules, layout)
            try:
                return self._figures(pipeline)
            finally:
                vk.vkDestroyPipeline(self._device, pipeline, None)
        finally:
            for module in modules:
                vk.vkDestroyShaderModule(self._device, module, None)
            vk.vkDestroyPipelineLayout(self._device, layout, None)
            vk.vkDestroyDescriptorSetLayout(self._device, set_layout, None)

    def _pipeline(self, modules: list[Any], layout: Any) -> Any:
        """A pipeline with the state of passes: triangles, no blending, half-float output, optional grid of vec2 as
        input."""
        vk = self._vk
        kinds = (vk.VK_SHADER_STAGE_VERTEX_BIT, vk.VK_SHADER_STAGE_FRAGMENT_BIT)
        stages = [
            vk.VkPipelineShaderStageCreateInfo(stage=kind, module=module, pName="main")
            for kind, module in zip(kinds, modules, strict=True)
        ]
        binding = vk.VkVertexInputBindingDescription(binding=0, stride=8, inputRate=vk.VK_VERTEX_INPUT_RATE_VERTEX)
        attribute = vk.VkVertexInputAttributeDescription(
            location=0, binding=0, format=vk.VK_FORMAT_R32G32_SFLOAT, offset=0
        )
        vertices = vk.VkPipelineVertexInputStateCreateInfo(
            pVertexBindingDescriptions=[binding], pVertexAttributeDescriptions=[attribute]
        )
        assembly = vk.VkPipelineInputAssemblyStateCreateInfo(
            topology=vk.VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, primitiveRestartEnable=0
        )
        viewport = vk.VkViewport(0.0, 0.0, 1280.0, 720.0, 0.0, 1.0)
        scissor = vk.VkRect2D(vk.VkOffset2D(0, 0), vk.VkExtent2D(1280, 720))
        viewports = vk.VkPipelineViewportStateCreateInfo(pViewports=[viewport], pScissors=[scissor])
        raster = vk.VkPipelineRasterizationStateCreateInfo(
            depthClampEnable=0, rasterizerDiscardEnable=0, polygonMode=0, cullMode=0, frontFace=0, depthBiasEnable=0,
            lineWidth=1.0,
        )  # fmt: skip
        samples = vk.VkPipelineMultisampleStateCreateInfo(rasterizationSamples=1, sampleShadingEnable=0)
        attachment = vk.VkPipelineColorBlendAttachmentState(blendEnable=0, colorWriteMask=0xF)
        blend = vk.VkPipelineColorBlendStateCreateInfo(
            logicOpEnable=0, pAttachments=[attachment] * OUTPUTS, blendConstants=[0.0, 0.0, 0.0, 0.0]
        )
        rendering = vk.VkPipelineRenderingCreateInfo(
            viewMask=0,
            colorAttachmentCount=OUTPUTS,
            pColorAttachmentFormats=[vk.VK_FORMAT_R16G16B16A16_SFLOAT] * OUTPUTS,
            depthAttachmentFormat=0,
            stencilAttachmentFormat=0,
        )
        info = vk.VkGraphicsPipelineCreateInfo(
            pNext=rendering,
            flags=vk.VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR,
            pStages=stages,
            pVertexInputState=vertices,
            pInputAssemblyState=assembly,
            pViewportState=viewports,
            pRasterizationState=raster,
            pMultisampleState=samples,
            pColorBlendState=blend,
            layout=layout,
        )
        return vk.vkCreateGraphicsPipelines(self._device, None, 1, [info], None)[0]

    def _figures(self, pipeline: Any) -> dict[str, Figures]:
        vk = self._vk
        figures: dict[str, Figures] = {}
        pipeline_info = vk.VkPipelineInfoKHR(pipeline=pipeline)
        for index, executable in enumerate(self._properties(self._device, pipeline_info)):
            info = vk.VkPipelineExecutableInfoKHR(pipeline=pipeline, executableIndex=index)
            values = {_text(vk, one.name): one.value.u64 for one in self._statistics(self._device, info)}
            figures[_STAGES[_text(vk, executable.name)]] = Figures(
                instructions=values["Instructions"],
                vgprs=values["VGPRs"],
                waves=values["Subgroups per SIMD"],
                spills=values["Spilled SGPRs"] + values["Spilled VGPRs"],
                bytes=values["Code size"],
            )
        if figures.keys() != {"vertex", "fragment"}:
            raise CompilerError(f"the driver gave figures of {sorted(figures)}")
        return figures


def _text(vk: Any, name: Any) -> str:
    return name if isinstance(name, str) else vk.ffi.string(name).decode()


def reflect(code: bytes) -> dict[int, str]:
    """Resources of a SPIR-V module by binding: a ``block`` of uniforms or a ``texture``."""
    words = struct.unpack(f"<{len(code) // 4}I", code)
    kinds: dict[int, str] = {}
    pointed: dict[int, int] = {}
    variables: dict[int, int] = {}
    bindings: dict[int, int] = {}
    at = _HEADER_WORDS
    while at < len(words):
        operation, length = words[at] & 0xFFFF, words[at] >> 16
        if operation == _DECORATE and words[at + 2] == _BINDING:
            bindings[words[at + 1]] = words[at + 3]
        elif operation == _TYPE_SAMPLED_IMAGE:
            kinds[words[at + 1]] = "texture"
        elif operation == _TYPE_STRUCT:
            kinds[words[at + 1]] = "block"
        elif operation == _TYPE_POINTER:
            pointed[words[at + 1]] = words[at + 3]
        elif operation == _VARIABLE:
            variables[words[at + 2]] = words[at + 1]
        at += length
    return {binding: kinds[pointed[variables[name]]] for name, binding in bindings.items()}


@contextmanager
def opened() -> Iterator[Radv]:
    """The null device while the context lasts. Raises :class:`CompilerError` if there is none."""
    driver_file = icd()
    if driver_file is None:
        raise CompilerError("no RADV: mesa-vulkan-drivers is not installed")
    chosen = {
        "RADV_FORCE_FAMILY": FAMILY,
        "VK_ICD_FILENAMES": str(driver_file),
        "XDG_RUNTIME_DIR": os.environ.get("XDG_RUNTIME_DIR", "/tmp"),
    }
    with patch.dict(os.environ, chosen):
        try:
            import vulkan
        except (ImportError, OSError) as error:
            raise CompilerError(f"no Vulkan: {error}") from error
        device = Radv(vulkan)
        try:
            yield device
        finally:
            device.close()
