//! What is depended on: licences, sources, second versions and build scripts, against the lists of
//! `.ci/deny.toml`. `cargo deny` reads the same file and knows advisories as well, but takes minutes to
//! build; this looks at the packages of the machine at hand and needs neither it nor the network.

use std::collections::{BTreeMap, HashSet};
use std::process::Command;

use serde::Deserialize;

#[derive(Deserialize)]
struct Rules {
    licenses: Licences,
    sources: Sources,
    bans: Bans,
}

#[derive(Deserialize)]
struct Licences {
    allow: Vec<String>,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Sources {
    allow_registry: Vec<String>,
}

#[derive(Deserialize)]
struct Bans {
    skip: Vec<Ban>,
    deny: Vec<Ban>,
    build: Build,
}

#[derive(Deserialize)]
struct Ban {
    /// A name, or a name and how its version starts: `syn@2`.
    #[serde(rename = "crate")]
    package: String,
    /// Packages that may depend on it all the same.
    #[serde(default)]
    wrappers: Vec<String>,
}

#[derive(Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Build {
    allow_build_scripts: Vec<String>,
}

#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    version: String,
    license: Option<String>,
    /// Nothing for the package that this test is part of.
    source: Option<String>,
    targets: Vec<Target>,
}

#[derive(Deserialize)]
struct Target {
    kind: Vec<String>,
}

fn rules() -> Rules {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/.ci/deny.toml");
    let text = std::fs::read_to_string(path).unwrap();
    basic_toml::from_str(&text).unwrap()
}

fn cargo(arguments: &[&str]) -> String {
    // Not offline: on a fresh machine manifests that no test is built from are still to be downloaded.
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .args(["--locked", "--all-features"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let complaints = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaints}");
    String::from_utf8(output.stdout).unwrap()
}

/// Names and versions of packages that are built on this machine, tests and benchmarks included.
fn built(which: &[&str]) -> Vec<(String, String)> {
    let as_a_list = [
        "tree",
        "--edges",
        "normal,build,dev",
        "--prefix",
        "none",
        "--format",
        "{p}",
    ];
    let tree = cargo(&[&as_a_list, which].concat());
    let lines = tree.lines().filter_map(|line| {
        let mut words = line.split(' ');
        let name = words.next()?;
        let version = words.next()?.strip_prefix('v')?;
        Some((name.to_owned(), version.to_owned()))
    });
    lines.collect()
}

/// What those packages say about themselves.
fn packages() -> Vec<Package> {
    let built: HashSet<(String, String)> = built(&[]).into_iter().collect();
    let host = host();
    let arguments = [
        "metadata",
        "--format-version",
        "1",
        "--filter-platform",
        &host,
    ];
    let metadata: Metadata = serde_json::from_str(&cargo(&arguments)).unwrap();
    // Cargo also tells of packages that belong to features nobody asked for.
    let is_built =
        |package: &Package| built.contains(&(package.name.clone(), package.version.clone()));
    let packages: Vec<Package> = metadata.packages.into_iter().filter(is_built).collect();
    assert_eq!(packages.len(), built.len());
    packages
}

/// The machine at hand, as the compiler calls it.
fn host() -> String {
    let version = Command::new("rustc").arg("-vV").output().unwrap().stdout;
    let version = String::from_utf8(version).unwrap();
    let host = version.lines().find_map(|line| line.strip_prefix("host: "));
    host.unwrap().to_owned()
}

fn is_built_by_a_script(package: &Package) -> bool {
    let is_script = |target: &Target| target.kind.iter().any(|kind| kind == "custom-build");
    package.targets.iter().any(is_script)
}

/// Whether the licences of an expression such as `(MIT OR Apache-2.0) AND Unicode-3.0` suffice.
fn is_licensed(expression: &str, allowed: &[String]) -> bool {
    // Older packages write a slash for OR.
    let expression = expression.replace('/', " OR ");
    let expression = expression.replace('(', " ( ").replace(')', " ) ");
    let mut words = expression.split_whitespace().peekable();
    let answer = any_of(&mut words, allowed);
    assert_eq!(words.next(), None, "not understood: {expression}");
    answer
}

type Words<'a> = std::iter::Peekable<std::str::SplitWhitespace<'a>>;

fn any_of(words: &mut Words, allowed: &[String]) -> bool {
    let mut answer = all_of(words, allowed);
    while words.next_if_eq(&"OR").is_some() {
        answer |= all_of(words, allowed);
    }
    answer
}

fn all_of(words: &mut Words, allowed: &[String]) -> bool {
    let mut answer = one(words, allowed);
    while words.next_if_eq(&"AND").is_some() {
        answer &= one(words, allowed);
    }
    answer
}

fn one(words: &mut Words, allowed: &[String]) -> bool {
    let word = words.next().expect("a licence");
    if word == "(" {
        let answer = any_of(words, allowed);
        assert_eq!(words.next(), Some(")"));
        return answer;
    }
    let mut name = word.to_owned();
    if words.next_if_eq(&"WITH").is_some() {
        name += " WITH ";
        name += words.next().expect("an exception");
    }
    allowed.contains(&name)
}

#[test]
fn every_package_has_a_licence_that_is_allowed() {
    let allowed = rules().licenses.allow;
    for package in packages() {
        let Package {
            name,
            version,
            license,
            ..
        } = &package;
        let license = license
            .as_deref()
            .unwrap_or_else(|| panic!("{name} {version} has no licence"));
        assert!(
            is_licensed(license, &allowed),
            "{name} {version}: {license}"
        );
    }
}

#[test]
fn a_licence_is_refused_unless_all_that_it_asks_for_is_allowed() {
    let allowed = ["MIT".to_owned(), "Zlib".to_owned()];
    for fine in [
        "MIT",
        "GPL-3.0 OR MIT",
        "Apache-2.0/MIT",
        "(GPL-3.0 OR MIT) AND Zlib",
        "MIT AND Zlib",
    ] {
        assert!(is_licensed(fine, &allowed), "{fine}");
    }
    for not in [
        "GPL-3.0",
        "MIT AND GPL-3.0",
        "(MIT OR Zlib) AND GPL-3.0",
        "Zlib WITH some-exception",
    ] {
        assert!(!is_licensed(not, &allowed), "{not}");
    }
}

#[test]
fn every_package_comes_from_the_registry() {
    let registries = rules().sources.allow_registry;
    for Package { name, source, .. } in packages() {
        let Some(source) = source else {
            assert_eq!(name, env!("CARGO_PKG_NAME"), "comes from a folder");
            continue;
        };
        let registry = source.strip_prefix("registry+").unwrap_or(&source);
        assert!(
            registries.iter().any(|allowed| allowed == registry),
            "{name} comes from {source}"
        );
    }
}

#[test]
fn second_versions_are_those_that_have_a_reason() {
    let skip = rules().bans.skip;
    let excused = |name: &str, version: &str| {
        skip.iter().any(|ban| {
            let (package, start) = ban.package.split_once('@').expect("a version");
            package == name && format!("{version}.").starts_with(&format!("{start}."))
        })
    };
    let mut versions: BTreeMap<String, Vec<String>> = BTreeMap::new();
    for Package { name, version, .. } in packages() {
        versions.entry(name).or_default().push(version);
    }
    for (name, mut versions) in versions {
        versions.retain(|version| !excused(&name, version));
        assert!(versions.len() <= 1, "{name}: {}", versions.join(", "));
    }
}

#[test]
fn build_scripts_are_those_that_were_read() {
    let read = rules().bans.build.allow_build_scripts;
    for package in packages() {
        let name = &package.name;
        assert!(
            !is_built_by_a_script(&package) || read.contains(name),
            "{name}: read its build.rs"
        );
    }
}

#[test]
fn nothing_calls_a_c_compiler_but_what_is_named() {
    let packages = packages();
    for Ban { package, wrappers } in rules().bans.deny {
        if !packages.iter().any(|built| built.name == package) {
            continue;
        }
        let tree = built(&["--invert", &package, "--depth", "1"]);
        for (dependent, _) in tree.iter().filter(|(name, _)| *name != package) {
            assert!(wrappers.contains(dependent), "{dependent} uses {package}");
        }
    }
}
