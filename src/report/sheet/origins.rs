//! Which numbers are from the library, and which of those nobody vouches for.

use crate::record::{OriginRecord, Record};

/// A line for published numbers and one for assumed ones, where there are any.
pub fn origins(record: &Record) -> Vec<(&'static str, String)> {
    let taken = taken(record);
    let of = |assumed: bool| {
        let groups: Vec<String> = taken
            .iter()
            .filter_map(|(name, numbers)| {
                let keys: Vec<&str> = numbers
                    .iter()
                    .filter_map(|(key, origin)| Some((key, origin.as_ref()?)))
                    .filter(|(_, origin)| origin.assumed == assumed)
                    .map(|(key, _)| *key)
                    .collect();
                (!keys.is_empty()).then(|| format!("{} of {name}", keys.join(", ")))
            })
            .collect();
        groups.join("; ")
    };
    let (published, assumed) = (of(false), of(true));
    let mut lines = Vec::new();
    if !published.is_empty() {
        let text = format!("{published}: published, `peenpose media` says where");
        lines.push(("library", text));
    }
    if !assumed.is_empty() {
        lines.push((
            "assumed",
            format!("{assumed}: nobody vouches for these figures"),
        ));
    }
    lines
}

type Numbers<'a> = Vec<(&'static str, &'a Option<OriginRecord>)>;

/// What the recommended settings take from the library.
fn taken(record: &Record) -> Vec<(String, Numbers<'_>)> {
    let problem = &record.problem;
    let medium = problem.medium.iter().map(|medium| {
        let numbers = vec![("diameter", &medium.diameter), ("density", &medium.density)];
        (medium.name.clone(), numbers)
    });
    // Names of surfaces have a point, those of contacts have none.
    let in_use = |name: &str| name == record.best.contact || name.contains('.');
    let contacts = problem
        .library_contacts
        .iter()
        .filter(|known| in_use(&known.contact))
        .map(|known| {
            let numbers = vec![
                ("mu_s", &known.mu_s),
                ("mu_d", &known.mu_d),
                ("restitution", &known.restitution),
                ("exponent of restitution", &known.restitution_exponent),
            ];
            (known.contact.clone(), numbers)
        });
    medium.chain(contacts).collect()
}
