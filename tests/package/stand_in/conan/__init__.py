"""Stand-ins for the few of Conan 2's classes that our recipe uses; an unknown name is an AttributeError."""


class _Options:
    def __init__(self, values):
        self.__dict__.update(values)

    def rm_safe(self, name):
        self.__dict__.pop(name, None)


class _Info:
    def __init__(self):
        self.libs, self.requires, self.system_libs, self.properties = [], [], [], {}

    def set_property(self, name, value):
        self.properties[name] = value


class _Package(_Info):
    def __init__(self):
        super().__init__()
        self.components = {"engine": _Info()}


class ConanFile:
    def __init__(self, folders, **options):
        self.recipe_folder, self.export_sources_folder = folders["recipe"], folders["sources"]
        self.source_folder, self.build_folder = folders["sources"], folders["build"]
        self.package_folder = folders["package"]
        unknown = set(options) - set(self.options)
        assert not unknown and set(self.default_options) == set(self.options), unknown
        self.options = _Options({**self.default_options, **options})
        self.cpp_info = _Package()
        self.required = []

    def requires(self, reference, transitive_headers=False):
        self.required.append(reference)
