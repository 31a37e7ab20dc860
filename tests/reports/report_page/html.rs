//! As much of HTML as a test of our own pages needs.

/// Elements without an end.
const VOID: [&str; 7] = ["meta", "br", "hr", "img", "input", "link", "col"];
/// Elements whose contents are not HTML.
const RAW: [&str; 2] = ["script", "style"];

/// A start tag.
#[derive(Debug)]
pub struct Tag {
    pub name: String,
    pub attributes: Vec<(String, String)>,
}

/// The start tags of a page; panics where an element is not closed, or text holds a bare `<`.
pub fn tags(page: &str) -> Vec<Tag> {
    let mut tags = Vec::new();
    let mut open: Vec<String> = Vec::new();
    let mut rest = page;
    while let Some(start) = rest.find('<') {
        rest = &rest[start..];
        if rest.starts_with("<!DOCTYPE html>") {
            rest = &rest["<!DOCTYPE html>".len()..];
        } else if let Some(end_tag) = rest.strip_prefix("</") {
            let end = end_tag.find('>').expect("an end tag ends");
            assert_eq!(
                open.pop().as_deref(),
                Some(&end_tag[..end]),
                "closed at {}",
                near(rest)
            );
            rest = &end_tag[end + 1..];
        } else {
            let (tag, is_closed, after) = start_tag(rest);
            rest = after;
            if RAW.contains(&tag.name.as_str()) {
                let end = format!("</{}>", tag.name);
                let at = rest
                    .find(&end)
                    .unwrap_or_else(|| panic!("{} is open", tag.name));
                rest = &rest[at + end.len()..];
            } else if !is_closed && !VOID.contains(&tag.name.as_str()) {
                open.push(tag.name.clone());
            }
            tags.push(tag);
        }
    }
    assert!(open.is_empty(), "still open: {open:?}");
    tags
}

/// A start tag, whether it ends itself, and what follows.
fn start_tag(text: &str) -> (Tag, bool, &str) {
    let is_name = |c: char| c.is_ascii_alphanumeric() || "-_:".contains(c);
    let split = |text: &'_ str| text.find(|c| !is_name(c)).unwrap_or(text.len());
    let mut rest = &text[1..];
    let end = split(rest);
    assert!(end > 0, "no tag at {}", near(text));
    let name = rest[..end].to_owned();
    rest = &rest[end..];
    let mut attributes = Vec::new();
    loop {
        rest = rest.trim_start();
        if let Some(after) = rest.strip_prefix("/>") {
            return (Tag { name, attributes }, true, after);
        }
        if let Some(after) = rest.strip_prefix('>') {
            return (Tag { name, attributes }, false, after);
        }
        let end = split(rest);
        assert!(end > 0, "no attribute at {}", near(rest));
        let attribute = rest[..end].to_owned();
        rest = &rest[end..];
        let mut value = String::new();
        if let Some(quoted) = rest.strip_prefix('=') {
            let quote = quoted.chars().next().filter(|c| "\"'".contains(*c));
            let quote = quote.unwrap_or_else(|| panic!("no quotes at {}", near(rest)));
            let end = quoted[1..].find(quote).expect("a value ends") + 1;
            value = quoted[1..end].to_owned();
            rest = &quoted[end + 1..];
        }
        attributes.push((attribute, value));
    }
}

fn near(text: &str) -> String {
    text.chars().take(80).collect()
}
