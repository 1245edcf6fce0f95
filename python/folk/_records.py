"""Tables for people: pandas where it is installed, else a list of dictionaries."""


def frame(records):
    """Rows (dictionaries with the same keys) as a pandas.DataFrame, or as they are without pandas."""
    try:
        import pandas
    except ImportError:
        return records
    return pandas.DataFrame(records)


def frame_of_columns(columns):
    """The same of columns of equal length."""
    try:
        import pandas
    except ImportError:
        return [dict(zip(columns, row)) for row in zip(*columns.values())]
    return pandas.DataFrame(columns)
