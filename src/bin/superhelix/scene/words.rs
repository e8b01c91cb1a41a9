//! The solver's complaints in the words of a scene.

use superhelix::Error;

use crate::shell::json::Complaint;

/// The solver names its own fields: the same complaint in the keys of a scene.
pub fn in_words_of_the_scene(error: Error) -> Complaint {
    let key = |argument: &str| {
        let argument =
            argument.split_once('.').map_or(argument, |(first, rest)| if first.contains('[') { argument } else { rest });
        let mut key = argument.replace(" (count)", "");
        for (field, name) in
            [("natural", "natural_curvatures"), ("initial", "initial_curvatures"), ("max_iterations", "newton.max_iterations")]
        {
            let mut parts: Vec<String> = key.split('.').map(str::to_string).collect();
            for part in &mut parts {
                let (stem, index) = part.find('[').map_or((part.as_str(), ""), |at| part.split_at(at));
                if stem == field {
                    *part = format!("{name}{index}");
                }
            }
            key = parts.join(".");
        }
        key
    };
    match error {
        Error::Unsupported { argument, value, hint } => {
            Complaint::new(key(&argument), format!("is {value}, which is unsupported in this version: {hint}"))
        }
        Error::InvalidArgument { argument, value, expected } => Complaint::value(key(&argument), value, expected),
        other => Complaint::new("", other.to_string()),
    }
}
