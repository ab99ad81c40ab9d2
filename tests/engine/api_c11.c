/* The C API from plain C11: every declaration compiles, and what needs no command buffer runs. The
 * loader is opened here, as a program would; without one, or without a device, this is skipped. */
#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

#include "engine/vkhausdorff.h"

enum { kSkipped = 77, kMostDevices = 8 };

static int failures = 0;
static VkDebugUtilsMessengerEXT messenger = VK_NULL_HANDLE; /* of the instance that is there */

static void check(int holds, const char* what) {
  if (holds) return;
  fprintf(stderr, "api_c11: not so: %s\n", what);
  ++failures;
}
#define CHECK(condition) check((condition), #condition)

static PFN_vkGetInstanceProcAddr open_loader(void) {
  PFN_vkGetInstanceProcAddr get = NULL;
#ifdef _WIN32
  HMODULE library = LoadLibraryA("vulkan-1.dll");
  FARPROC symbol = library != NULL ? GetProcAddress(library, "vkGetInstanceProcAddr") : NULL;
#else
  void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
  void* symbol = library != NULL ? dlsym(library, "vkGetInstanceProcAddr") : NULL;
#endif
  memcpy(&get, &symbol, sizeof get); /* ISO C has no cast from an object to a function */
  return get;
}

static VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                 VkDebugUtilsMessageTypeFlagsEXT types,
                                                 const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                 void* user) {
  (void)severity, (void)types, (void)user;
  check(0, data->pMessage);
  return VK_FALSE;
}

/* With VKH_VALIDATION the validation layer looks on, and its messages are failures. */
static VkInstance create_instance(PFN_vkGetInstanceProcAddr get, uint32_t version) {
  const char *layer = "VK_LAYER_KHRONOS_validation", *extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  const VkDebugUtilsMessengerCreateInfoEXT listen = {
      .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
      .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                         VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
      .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
      .pfnUserCallback = on_message};
  const VkApplicationInfo app = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                 .apiVersion = version};
  VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                               .pApplicationInfo = &app,
                               .ppEnabledLayerNames = &layer,
                               .ppEnabledExtensionNames = &extension};
  VkInstance instance = VK_NULL_HANDLE;
  PFN_vkCreateInstance create = (PFN_vkCreateInstance)get(NULL, "vkCreateInstance");
  if (create == NULL) return VK_NULL_HANDLE;
  info.enabledLayerCount = info.enabledExtensionCount = getenv("VKH_VALIDATION") != NULL;
  if (info.enabledLayerCount == 1 && create(&info, NULL, &instance) == VK_SUCCESS) {
    ((PFN_vkCreateDebugUtilsMessengerEXT)get(instance, "vkCreateDebugUtilsMessengerEXT"))(
        instance, &listen, NULL, &messenger);
    return instance;
  }
  info.enabledLayerCount = info.enabledExtensionCount = 0;
  return create(&info, NULL, &instance) == VK_SUCCESS ? instance : VK_NULL_HANDLE;
}

static void destroy_instance(PFN_vkGetInstanceProcAddr get, VkInstance instance) {
  if (messenger != VK_NULL_HANDLE)
    ((PFN_vkDestroyDebugUtilsMessengerEXT)get(instance, "vkDestroyDebugUtilsMessengerEXT"))(
        instance, messenger, NULL);
  messenger = VK_NULL_HANDLE;
  ((PFN_vkDestroyInstance)get(instance, "vkDestroyInstance"))(instance, NULL);
}

/* The first device that is supported; the reasons against the others are text. */
static VkPhysicalDevice choose(VkhDeviceInfo info) {
  VkPhysicalDevice devices[kMostDevices], chosen = VK_NULL_HANDLE;
  uint32_t count = kMostDevices, i;
  PFN_vkEnumeratePhysicalDevices list = (PFN_vkEnumeratePhysicalDevices)info.getInstanceProcAddr(
      info.instance, "vkEnumeratePhysicalDevices");
  if (list(info.instance, &count, devices) < 0) return VK_NULL_HANDLE;
  for (i = 0; i < count; ++i) {
    char reasons[256] = "untouched", start[8] = "-------";
    VkhResult result;
    info.physicalDevice = devices[i];
    result = vkhQuerySupport(&info, reasons, sizeof reasons);
    CHECK(result == VKH_SUCCESS || result == VKH_ERROR_UNSUPPORTED);
    CHECK((result == VKH_SUCCESS) == (reasons[0] == '\0'));
    CHECK(vkhQuerySupport(&info, NULL, 0) == result);
    CHECK(vkhQuerySupport(&info, start, sizeof start) == result);
    CHECK(strlen(start) < sizeof start && strncmp(start, reasons, strlen(start)) == 0);
    if (result == VKH_SUCCESS && chosen == VK_NULL_HANDLE) chosen = devices[i];
  }
  return chosen;
}

/* Nothing is enabled but what the header asks for, as it shows; api_contract_test compares the
 * lines. `bare`: without the extensions. */
static VkDevice create_device(VkhDeviceInfo info, int bare) {
  const float priority = 1.0f;
  VkDevice device = VK_NULL_HANDLE;
  VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                   .queueCount = 1,
                                   .pQueuePriorities = &priority};
  PFN_vkCreateDevice create_with =
      (PFN_vkCreateDevice)info.getInstanceProcAddr(info.instance, "vkCreateDevice");
  VkPhysicalDeviceSynchronization2Features synchronization = {
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES,
      .synchronization2 = VK_TRUE};
  VkPhysicalDeviceScalarBlockLayoutFeatures scalar = {
      .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES,
      .pNext = &synchronization,
      .scalarBlockLayout = VK_TRUE};
  VkDeviceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                               .pNext = &scalar,
                               .queueCreateInfoCount = 1,
                               .pQueueCreateInfos = &queue};
  create.ppEnabledExtensionNames = vkhGetRequiredExtensions(&info, &create.enabledExtensionCount);
  if (bare) create.enabledExtensionCount = 0;
  if (bare) create.pNext = NULL;
  if (create_with(info.physicalDevice, &create, NULL, &device) != VK_SUCCESS) return VK_NULL_HANDLE;
  return device;
}

static void check_sizes(VkhContext context) {
  VkhHierarchyRequirements hierarchy = {0}, larger = {0};
  VkhWorkspaceRequirements workspace = {0, 0, 0, 0};
  CHECK(vkhGetHierarchyRequirements(context, 3, 1, &hierarchy) == VKH_SUCCESS);
  CHECK(vkhGetHierarchyRequirements(context, 30000, 60000, &larger) == VKH_SUCCESS);
  CHECK(hierarchy.hierarchySize > 0 && hierarchy.scratchSize > 0);
  CHECK(larger.hierarchySize > hierarchy.hierarchySize);
  CHECK(vkhGetWorkspaceRequirements(context, 3, 1, &workspace) == VKH_SUCCESS);
  CHECK(workspace.minimum > 0 && workspace.minimum <= workspace.compact);
  CHECK(workspace.compact <= workspace.recommended);
  CHECK(workspace.compact < 256 * 1024); /* of a triangle */
  CHECK(workspace.recommended <= workspace.maximum);
  CHECK(vkhGetHierarchyRequirements(context, 3, 0, &hierarchy) == VKH_ERROR_TOO_LARGE);
  CHECK(vkhGetWorkspaceRequirements(context, UINT32_MAX, 1, &workspace) == VKH_ERROR_TOO_LARGE);
}

static void check_context(VkhDeviceInfo info) {
  VkhContextCreateInfo create = {.size =
                                     sizeof create}; /* certified, and what pays on the device */
  VkhContext context = NULL;
  PFN_vkDestroyDevice destroy =
      (PFN_vkDestroyDevice)info.getInstanceProcAddr(info.instance, "vkDestroyDevice");
  info.device = create_device(info, 0);
  CHECK(info.device != VK_NULL_HANDLE);
  if (info.device == VK_NULL_HANDLE) return;
  create.device = info;
  create.threads = 1;
  create.size -= 1;
  CHECK(vkhCreateContext(&create, &context) == VKH_ERROR_MISUSE);
  create.size = sizeof create;
  create.flags = 1; /* none has this bit */
  CHECK(vkhCreateContext(&create, &context) == VKH_ERROR_MISUSE);
  create.flags = VKH_CONTEXT_CHECK_INPUT;
  CHECK(vkhCreateContext(&create, &context) == VKH_SUCCESS);
  if (context != NULL) check_sizes(context);
  vkhDestroyContext(context);
  vkhDestroyContext(NULL);
  destroy(info.device, NULL);
}

/* Whether a function of a required extension is missing on the device: not where all that is
 * required is in the driver's core version, too, as on SwiftShader. */
static int lacks_pushes(VkhDeviceInfo info) {
  uint32_t count = 0;
  const char* const* names = vkhGetRequiredExtensions(&info, &count);
  PFN_vkGetDeviceProcAddr get =
      (PFN_vkGetDeviceProcAddr)info.getInstanceProcAddr(info.instance, "vkGetDeviceProcAddr");
  for (uint32_t i = 0; i < count; ++i) {
    if (strcmp(names[i], "VK_KHR_push_descriptor") == 0)
      return get(info.device, "vkCmdPushDescriptorSetKHR") == NULL;
  }
  return 0;
}

/* vkhQuerySupport cannot see that the extensions were not enabled; creating a context can, where a
 * function is missing then. */
static void check_bare_device(VkhDeviceInfo info) {
  VkhContextCreateInfo create = {.size = sizeof create};
  VkhContext context = NULL;
  PFN_vkDestroyDevice destroy =
      (PFN_vkDestroyDevice)info.getInstanceProcAddr(info.instance, "vkDestroyDevice");
  info.device = create_device(info, 1);
  if (info.device == VK_NULL_HANDLE) return;
  create.device = info;
  if (lacks_pushes(info)) {
    CHECK(vkhCreateContext(&create, &context) == VKH_ERROR_NOT_ENABLED);
    CHECK(context == NULL);
  }
  destroy(info.device, NULL);
}

/* An instance that is too old is named as `reason` says, and so is the device that it has. */
static void check_refused(VkhDeviceInfo info, const char* reason) {
  VkhContextCreateInfo create = {.size = sizeof create};
  VkhContext context = NULL;
  uint32_t count = 1;
  char reasons[256] = "";
  CHECK(vkhQuerySupport(&info, reasons, sizeof reasons) == VKH_ERROR_UNSUPPORTED);
  check(strcmp(reasons, reason) == 0, reasons);
  vkhGetRequiredExtensions(&info, &count);
  CHECK(count == 0);
  create.device = info;
  CHECK(vkhCreateContext(&create, &context) == VKH_ERROR_UNSUPPORTED);
}

/* A device that runs the engine, asked through an instance that is too old for it: told so, and
 * where nothing but the device shows it. No call may be one that the instance does not have. */
static void check_old_instance(PFN_vkGetInstanceProcAddr get, uint32_t minor) {
  const uint32_t version = VK_MAKE_API_VERSION(0, 1, minor, 0);
  VkhDeviceInfo info = {.getInstanceProcAddr = get, .instance = create_instance(get, version)};
  uint32_t count = 1;
  char reason[80];
  snprintf(reason, sizeof reason, "the instance was created for Vulkan 1.%u, not 1.2 or later",
           minor);
  if (info.instance == VK_NULL_HANDLE) return;
  if (((PFN_vkEnumeratePhysicalDevices)get(info.instance, "vkEnumeratePhysicalDevices"))(
          info.instance, &count, &info.physicalDevice) >= 0) {
    info.apiVersion = version;
    check_refused(info, reason);
    info.device = create_device(info, 1);
    CHECK(info.device != VK_NULL_HANDLE);
    info.apiVersion = 0;
    check_refused(info, reason);
    ((PFN_vkDestroyDevice)get(info.instance, "vkDestroyDevice"))(info.device, NULL);
  }
  destroy_instance(get, info.instance);
}

static void check_names(void) {
  CHECK(strcmp(vkhResultString(VKH_SUCCESS), "VKH_SUCCESS") == 0);
  CHECK(strcmp(vkhResultString(VKH_ERROR_NOT_ENABLED), "VKH_ERROR_NOT_ENABLED") == 0);
  CHECK(strncmp(vkhResultString((VkhResult)1234), "no VkhResult", 12) == 0);
}

int main(void) {
  VkhDeviceInfo info = {.apiVersion = VK_API_VERSION_1_3};
  static_assert(sizeof(VkhReport) == 72, "no padding, and what a frame reads");
  static_assert(sizeof(VkhStatistics) == 4 * (4 + VKH_MAX_CULLS + 7 * VKH_MAX_WAVE_RECORDS),
                "no padding");
  check_names();
  info.getInstanceProcAddr = open_loader();
  if (info.getInstanceProcAddr != NULL)
    info.instance = create_instance(info.getInstanceProcAddr, info.apiVersion);
  if (info.instance != VK_NULL_HANDLE) info.physicalDevice = choose(info);
  if (info.physicalDevice == VK_NULL_HANDLE) {
    puts("api_c11: no loader or no supported device; only what needs none was checked");
    return failures > 0 ? 1 : kSkipped;
  }
  check_context(info);
  check_bare_device(info);
  destroy_instance(info.getInstanceProcAddr, info.instance);
  check_old_instance(info.getInstanceProcAddr, 0);
  check_old_instance(info.getInstanceProcAddr, 1);
  return failures > 0 ? 1 : 0;
}
