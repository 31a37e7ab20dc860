use super::*;

const TEXT: &str = "\
format: 1
contacts:            # pairs
  dry: { mu_s: 0.3, restitution: 0.25 }   # as measured
  wet:
    mu_s: 0.1
    restitution: 0.2 # guessed
settings: { speed: [5 m/s, 40 m/s] }
surfaces:
  hub.bore: { allow: 5 uN.s }
empty:
nil: ~ # none
list:
  - a: 1
  - b: 2
range: # of two
- 1 m   # at least

- 2 m   # at most
text: >-
  two
  lines
long: two
  lines
last:
  - 3
";

fn changed(changes: &[&str]) -> Result<String, String> {
    let changes: Result<Vec<Change>, String> = changes.iter().map(|it| Change::parse(it)).collect();
    Ok(Template::new(TEXT)?.with(&changes?)?.text)
}

#[test]
fn one_value_changes_and_all_else_stays() {
    for (change, old, new) in [
        (
            "contacts.dry.restitution=0.3",
            "restitution: 0.25",
            "restitution: 0.3",
        ),
        (
            "contacts.wet.restitution=0.3",
            "0.2 # guessed",
            "0.3 # guessed",
        ),
        (
            "contacts.wet={ mu_s: 0.4 }",
            "\n    mu_s: 0.1\n    restitution: 0.2 #",
            "\n    { mu_s: 0.4 } #",
        ),
        (
            "settings.speed=[6 m/s, 7 m/s]",
            "[5 m/s, 40 m/s]",
            "[6 m/s, 7 m/s]",
        ),
        ("settings.speed[1]=7 m/s", "40 m/s", "7 m/s"),
        ("list[1].b=3", "b: 2", "b: 3"),
        ("surfaces.hub.bore.allow=6 uN.s", "5 uN.s", "6 uN.s"),
        ("empty=1", "empty:", "empty: 1"),
        ("nil=1", "nil: ~ #", "nil: 1 #"),
        // Lists may begin in the column of their key, where no other value may.
        (
            "range=[3 m, 4 m]",
            "range: # of two\n- 1 m   # at least\n\n- 2 m   # at most",
            "range: [3 m, 4 m] # of two   # at most",
        ),
        ("range[0]=0 m", "- 1 m ", "- 0 m "),
        ("list=1", "list:\n  - a: 1\n  - b: 2", "list:\n  1"),
        ("last=4", "last:\n  - 3", "last:\n  4"),
        ("text=one", ">-\n  two\n  lines", ">-\n  one"),
        ("long=one", "long: two\n  lines", "long: one"),
        // What is not there is added to its group.
        (
            "contacts.dry.mu_d=0.2",
            "{ mu_s: 0.3,",
            "{ mu_d: 0.2, mu_s: 0.3,",
        ),
        (
            "contacts.wet.mu_d=0.2",
            "    restitution: 0.2",
            "    mu_d: 0.2\n    restitution: 0.2",
        ),
        (
            "contacts.oil={ mu_s: 0.1 }",
            "  wet:\n",
            "  oil: { mu_s: 0.1 }\n  wet:\n",
        ),
        (
            "contacts.oil.mu_s=0.1",
            "  wet:\n",
            "  oil: { mu_s: 0.1 }\n  wet:\n",
        ),
        (
            "surfaces.hub.floor.allow=6 uN.s",
            "  hub.bore",
            "  hub.floor: { allow: 6 uN.s }\n  hub.bore",
        ),
        ("solve.seed=2", "last:", "solve: { seed: 2 }\nlast:"),
        ("list[0].c=2", "- a: 1", "- c: 2\n    a: 1"),
    ] {
        assert_eq!(
            changed(&[change]).unwrap(),
            TEXT.replacen(old, new, 1),
            "{change}"
        );
    }
    let both = changed(&["solve.seed=2", "solve.accuracy=2 %", "solve.seed=3"]).unwrap();
    assert!(
        both.contains("solve: { accuracy: 2 %, seed: 3 }\n"),
        "{both}"
    );
}

#[test]
fn what_cannot_be_changed_is_refused_with_its_key() {
    for (change, reason) in [
        ("contacts.dry.restitution", "expected KEY=VALUE"),
        ("=1", "no key path"),
        ("a b=1", "no key path"),
        ("list[x]=1", "no key path"),
        ("format=", "there is no value"),
        ("format=~", "there is no value"),
        ("format=1 # one", "no value on one line"),
        ("format=a: b: c", "no value on one line"),
        ("format=1 }, { x: 2", "no value on one line"),
        ("format=1, x: 2", "no value on one line"),
        ("format=[1", "no value on one line"),
        ("format.a=1", "`a` would be in what is no group"),
        ("contacts[0]=1", "[0] would be in what is no list"),
        ("list[2].a=1", "the list has 2 items"),
        ("new[0]=1", "there is no list `new`"),
    ] {
        let fault = changed(&[change]).unwrap_err();
        assert!(fault.contains(reason), "{change}: {fault}");
    }
}

/// An anchor is used elsewhere: what repeats it would change as well.
#[test]
fn an_anchored_value_is_left_alone() {
    let text = "a: &x { b: 1 }\nc: *x\n";
    let with = |change: &str| {
        Template::new(text)
            .unwrap()
            .with(&[Change::parse(change).unwrap()])
    };
    assert!(with("a.b=2").unwrap_err().contains("without anchors"));
    assert_eq!(with("c=2").unwrap().text(), "a: &x { b: 1 }\nc: 2\n");
}
